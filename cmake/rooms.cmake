# cairn_room(<name> HEADERS ... SOURCES ... [TESTS ...] [KIT ...] [LONG ...] [PUBLIC ...] [PRIVATE ...])
#
# A room is one static library, cairn::<name>, with its unit tests in one executable, cairn_<name>_tests. KIT names the
# parts of the test kit that the tests use (src/cairn/testing), LONG the test suites that take longest. PUBLIC are the
# rooms and libraries whose types its headers show, PRIVATE those that only its sources know. The target cairn_headers
# compiles each header of each room alone, apart from the precompiled ones, for which tests/check_includes.py looks.
add_custom_target(cairn_headers)

function(cairn_room name)
  cmake_parse_arguments(ROOM "" "" "HEADERS;SOURCES;TESTS;KIT;LONG;PUBLIC;PRIVATE" ${ARGN})
  add_library(cairn_${name} STATIC ${ROOM_SOURCES})
  add_library(cairn::${name} ALIAS cairn_${name})
  target_sources(cairn_${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${CMAKE_SOURCE_DIR}/src FILES ${ROOM_HEADERS})
  target_link_libraries(cairn_${name} PUBLIC ${ROOM_PUBLIC} PRIVATE ${ROOM_PRIVATE} cairn_compile_options)
  cairn_precompile(cairn_${name})
  cairn_check_headers(${name} ${ROOM_HEADERS})
  if(CAIRN_TESTS AND ROOM_TESTS)
    add_executable(cairn_${name}_tests ${ROOM_TESTS})
    list(TRANSFORM ROOM_KIT PREPEND cairn::testing_)
    target_link_libraries(cairn_${name}_tests PRIVATE cairn::${name} ${ROOM_KIT} cairn_gtest_main cairn_compile_options)
    cairn_precompile(cairn_${name}_tests TEST)
    target_compile_definitions(cairn_${name}_tests PRIVATE CAIRN_DATA_DIR="${CAIRN_DATA_DIR}")
    cairn_discover_suites(cairn_${name}_tests ${name} ${ROOM_LONG})
  endif()
endfunction()

function(cairn_check_headers name)
  foreach(header ${ARGN})
    set(source ${CMAKE_CURRENT_BINARY_DIR}/headers/${header}.cpp)
    file(RELATIVE_PATH path ${CMAKE_SOURCE_DIR}/src ${CMAKE_CURRENT_SOURCE_DIR}/${header})
    file(CONFIGURE OUTPUT ${source} CONTENT "#include \"${path}\"\n")
    list(APPEND sources ${source})
  endforeach()
  add_library(cairn_${name}_header_check OBJECT EXCLUDE_FROM_ALL ${sources})
  target_link_libraries(cairn_${name}_header_check PRIVATE cairn::${name} cairn_compile_options)
  cairn_precompile(cairn_${name}_header_check)
  add_dependencies(cairn_headers cairn_${name}_header_check)
endfunction()
