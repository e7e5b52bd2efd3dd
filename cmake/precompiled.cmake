# cairn_precompile(<target> [TEST])
#
# Lets the sources of a target begin with headers that are compiled once for all rooms: Eigen's core and the part of the
# standard library that most of our sources include; with TEST GoogleTest as well. Sources still include what they use:
# tests/check_includes.py looks for the names that these headers give.
set(CAIRN_PRECOMPILED_HEADERS
  <Eigen/Core> <Eigen/Geometry> <Eigen/Cholesky> <Eigen/LU>
  <fmt/format.h>
  <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory> <numbers> <numeric> <optional>
  <span> <string> <string_view> <utility> <vector>)

function(cairn_precompiled_headers name)
  cmake_parse_arguments(HEADERS "" "" "HEADERS;LIBRARIES" ${ARGN})
  set(source ${CMAKE_BINARY_DIR}/${name}.cpp)  # a target needs one
  file(CONFIGURE OUTPUT ${source} CONTENT "// Nothing: this target holds precompiled headers.\n")
  add_library(${name} OBJECT ${source})
  target_link_libraries(${name} PRIVATE Eigen3::Eigen fmt::fmt ${HEADERS_LIBRARIES} cairn_compile_options)
  target_precompile_headers(${name} PRIVATE ${HEADERS_HEADERS})
endfunction()

cairn_precompiled_headers(cairn_room_headers HEADERS ${CAIRN_PRECOMPILED_HEADERS})
if(CAIRN_TESTS)
  cairn_precompiled_headers(cairn_test_headers HEADERS ${CAIRN_PRECOMPILED_HEADERS} <gtest/gtest.h> LIBRARIES GTest::gtest)
endif()

function(cairn_precompile target)
  cmake_parse_arguments(PRECOMPILE "TEST" "" "" ${ARGN})
  set(headers cairn_room_headers)
  if(PRECOMPILE_TEST)
    set(headers cairn_test_headers)
  endif()
  target_precompile_headers(${target} REUSE_FROM ${headers})
  # a precompiled header counts only where the macros that its headers ask for are the same
  target_compile_definitions(${target} PRIVATE $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)
endfunction()
