# SPDX-License-Identifier: Apache-2.0
# cairn_discover_suites(<executable> <prefix> [<long suite>...])
#
# Registers each test suite of a GoogleTest executable as one test, <prefix>.<Suite>, after the executable is built. One
# process for each of 2,000 cases took longer to start than most cases run. A suite whose cases were all skipped counts
# as skipped: tests/gtest_main.cpp ends with 77 then. Long suites begin first, so that no core waits for one at the end.
add_library(cairn_gtest_main STATIC ${CMAKE_SOURCE_DIR}/tests/gtest_main.cpp)
target_link_libraries(cairn_gtest_main PUBLIC GTest::gtest PRIVATE cairn_compile_options)

function(cairn_discover_suites executable prefix)
  set(list ${CMAKE_CURRENT_BINARY_DIR}/${executable}_suites.cmake)
  add_custom_command(TARGET ${executable} POST_BUILD
    COMMAND ${CMAKE_COMMAND} -D EXECUTABLE=$<TARGET_FILE:${executable}> -D PREFIX=${prefix} -D LIST=${list}
            "-DLONG=${ARGN}"
            -P ${CMAKE_SOURCE_DIR}/cmake/list_suites.cmake
    BYPRODUCTS ${list} VERBATIM)
  set_property(TARGET ${executable} APPEND PROPERTY LINK_DEPENDS ${CMAKE_SOURCE_DIR}/cmake/list_suites.cmake)
  set(include ${CMAKE_CURRENT_BINARY_DIR}/${executable}_include.cmake)
  file(WRITE ${include}
    "if(EXISTS \"${list}\")\n  include(\"${list}\")\nelse()\n  add_test(${prefix}.NOT_BUILT ${executable}_NOT_BUILT)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${include})
endfunction()
