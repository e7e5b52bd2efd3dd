# cairn_unity(all|tests)
#
# Lets the sources of each target, or of each executable of tests, compile in groups that read the headers of libraries
# once and make one copy of what they instantiate: a third less time. A change in one source compiles its whole group,
# and a name that then has two meanings in a group needs `cmake` again; the preset `dev` has no groups.
function(cairn_unity which)
  cairn_targets_below(${CMAKE_SOURCE_DIR} targets)
  if(which STREQUAL "tests")
    list(FILTER targets INCLUDE REGEX "_tests$")
  endif()
  set(lines "")
  foreach(target ${targets})
    get_target_property(folder ${target} SOURCE_DIR)
    get_target_property(sources ${target} SOURCES)
    foreach(source ${sources})
      if(source MATCHES "^[^$]*\\.cpp$")
        cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder})
        string(APPEND lines "${target}\t${source}\n")
      endif()
    endforeach()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  endforeach()
  file(WRITE ${CMAKE_BINARY_DIR}/unity_sources.txt "${lines}")
  execute_process(COMMAND python3 ${CMAKE_SOURCE_DIR}/tests/unity_groups.py
    INPUT_FILE ${CMAKE_BINARY_DIR}/unity_sources.txt OUTPUT_FILE ${CMAKE_BINARY_DIR}/unity_groups.cmake
    COMMAND_ERROR_IS_FATAL ANY)
  include(${CMAKE_BINARY_DIR}/unity_groups.cmake)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # g++ takes the sources of a group for headers, and a class in one that has a member of an unnamed namespace for a fault
    target_compile_options(cairn_compile_options INTERFACE -Wno-subobject-linkage)
  endif()
endfunction()

function(cairn_targets_below folder result)  # that have sources of their own
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  get_property(folders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  set(found "")
  foreach(target ${targets})
    get_target_property(type ${target} TYPE)
    if(type MATCHES "^(EXECUTABLE|STATIC_LIBRARY|OBJECT_LIBRARY)$")
      list(APPEND found ${target})
    endif()
  endforeach()
  foreach(below ${folders})
    cairn_targets_below(${below} more)
    list(APPEND found ${more})
  endforeach()
  set(${result} ${found} PARENT_SCOPE)
endfunction()
