# talus_room(NAME sources... [LINK libraries...]): one static library for each room of the house,
# which may use only the rooms named after LINK.
function(talus_room name)
  cmake_parse_arguments(ROOM "" "" "LINK" ${ARGN})
  add_library(talus_${name} STATIC ${ROOM_UNPARSED_ARGUMENTS})
  target_link_libraries(talus_${name} PUBLIC talus_options ${ROOM_LINK})
  if(TARGET talus_headers)
    target_precompile_headers(talus_${name} REUSE_FROM talus_headers)
    talus_join_sources(talus_${name})
  endif()
endfunction()

# Compiles the sources of a target several at a time, as one text: most of the time goes into headers, which are read
# once then. Names that sources keep to themselves must not clash within a target.
function(talus_join_sources target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${TALUS_UNITY})
  if(TALUS_UNITY)
    # gcc takes a type of such a source for one of a header.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()

# talus_test(NAME LABEL sources... [SHARED_BED] [TIMEOUT s] [LINK libraries...]): one GoogleTest program, its cases known
# to ctest; the target LABEL_tests builds those of a label. Cases that share a bed, which takes long to make, run in one
# process and are one test of ctest; with AddressSanitizer, whose processes start slowly, all cases of a program are.
function(talus_test name label)
  cmake_parse_arguments(TEST "SHARED_BED" "TIMEOUT" "LINK" ${ARGN})
  if(NOT TEST_TIMEOUT)
    set(TEST_TIMEOUT 120)
  endif()
  add_executable(${name} ${TEST_UNPARSED_ARGUMENTS})
  target_link_libraries(${name} PRIVATE ${TEST_LINK} talus_test_options GTest::gtest_main)
  target_precompile_headers(${name} REUSE_FROM talus_test_headers)
  # Sources of the program that a test compiles too: clang-tidy reads them, and knows no precompiled headers of gcc.
  foreach(source ${TEST_UNPARSED_ARGUMENTS})
    if(source MATCHES "/src/")
      set_source_files_properties(${source} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
    endif()
  endforeach()
  if(NOT TARGET ${label}_tests)
    add_custom_target(${label}_tests)
  endif()
  add_dependencies(${label}_tests ${name})
  if(TALUS_SANITIZE)
    math(EXPR TEST_TIMEOUT "5 * ${TEST_TIMEOUT}")
  endif()
  if(TEST_SHARED_BED OR TALUS_SANITIZE)
    add_test(NAME ${name} COMMAND ${name})
    set_tests_properties(${name} PROPERTIES LABELS ${label} TIMEOUT ${TEST_TIMEOUT})
  else()
    gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES LABELS ${label} TIMEOUT ${TEST_TIMEOUT})
  endif()
endfunction()
