# talus_room(NAME sources... [LINK libraries...]): one static library for each room of the house,
# which may use only the rooms named after LINK.
function(talus_room name)
  cmake_parse_arguments(ROOM "" "" "LINK" ${ARGN})
  add_library(talus_${name} STATIC ${ROOM_UNPARSED_ARGUMENTS})
  target_link_libraries(talus_${name} PUBLIC talus_options ${ROOM_LINK})
endfunction()

# talus_test(NAME LABEL sources... [LINK libraries...]): one GoogleTest program, its cases known to ctest; the
# target LABEL_tests builds those of a label.
function(talus_test name label)
  cmake_parse_arguments(TEST "" "TIMEOUT" "LINK" ${ARGN})
  if(NOT TEST_TIMEOUT)
    set(TEST_TIMEOUT 120)
  endif()
  add_executable(${name} ${TEST_UNPARSED_ARGUMENTS})
  target_link_libraries(${name} PRIVATE ${TEST_LINK} talus_test_support GTest::gtest_main)
  if(NOT TARGET ${label}_tests)
    add_custom_target(${label}_tests)
  endif()
  add_dependencies(${label}_tests ${name})
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES LABELS ${label} TIMEOUT ${TEST_TIMEOUT})
endfunction()
