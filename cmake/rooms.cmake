# cairn_room(<name> HEADERS ... SOURCES ... [TESTS ...] [PUBLIC ...] [PRIVATE ...])
#
# A room is one static library, cairn::<name>, with its headers in a verified file set (each compiles alone)
# and its unit tests in one executable, cairn_<name>_tests. PUBLIC are the rooms and libraries whose types its
# headers show, PRIVATE those that only its sources know.
function(cairn_room name)
  cmake_parse_arguments(ROOM "" "" "HEADERS;SOURCES;TESTS;PUBLIC;PRIVATE" ${ARGN})
  add_library(cairn_${name} STATIC ${ROOM_SOURCES})
  add_library(cairn::${name} ALIAS cairn_${name})
  target_sources(cairn_${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${CMAKE_SOURCE_DIR}/src FILES ${ROOM_HEADERS})
  target_link_libraries(cairn_${name} PUBLIC ${ROOM_PUBLIC} PRIVATE ${ROOM_PRIVATE} cairn_compile_options)
  set_target_properties(cairn_${name} PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON)
  if(CAIRN_TESTS AND ROOM_TESTS)
    add_executable(cairn_${name}_tests ${ROOM_TESTS})
    target_link_libraries(cairn_${name}_tests PRIVATE cairn::${name} GTest::gtest_main cairn_compile_options)
    target_compile_definitions(cairn_${name}_tests PRIVATE CAIRN_DATA_DIR="${CAIRN_DATA_DIR}")
    gtest_discover_tests(cairn_${name}_tests TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60)
  endif()
endfunction()
