# talus_room(NAME sources... [LINK libraries...]): adds the static library of a room,
# which may use only the rooms named after LINK.
function(talus_room name)
  cmake_parse_arguments(ROOM "" "" "LINK" ${ARGN})
  add_library(talus_${name} STATIC ${ROOM_UNPARSED_ARGUMENTS})
  target_link_libraries(talus_${name} PUBLIC talus_options ${ROOM_LINK})
  # For the shared library and the Python extension.
  set_target_properties(talus_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_options(talus_${name} PRIVATE ${TALUS_ROOM_OPTIONS})
  if(TALUS_EMBEDDED)
    talus_embed_into(talus_${name} ${TALUS_EMBEDDED})
  endif()
  if(TARGET talus_headers)
    target_precompile_headers(talus_${name} REUSE_FROM talus_headers)
  endif()
  if(TALUS_JOIN)
    talus_join_sources(talus_${name})
  endif()
endfunction()

# talus_join_sources(target): compiles the sources of a target eight at a time, as one text, so that headers, which take most
# of the time, are read once. Local names of sources must not clash within a target. CMake's own
# UNITY_BUILD uses absolute paths, so that clones could not share the compiler cache.
function(talus_join_sources target)
  # gcc mistakes the types of such a source for types of a header.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  get_target_property(sources ${target} SOURCES)
  set(compiled "")
  set(count 0)
  foreach(source ${sources})
    get_source_file_property(alone ${source} SKIP_UNITY_BUILD_INCLUSION)
    cmake_path(ABSOLUTE_PATH source NORMALIZE OUTPUT_VARIABLE path)
    cmake_path(IS_PREFIX CMAKE_BINARY_DIR ${path} generated)
    if(alone OR generated OR NOT source MATCHES "\\.cpp$")
      list(APPEND compiled ${source})
      continue()
    endif()
    cmake_path(RELATIVE_PATH path BASE_DIRECTORY ${CMAKE_SOURCE_DIR})
    math(EXPR last "${count} / 8")
    string(APPEND text_${last} "#include \"${path}\"\n")
    math(EXPR count "${count} + 1")
  endforeach()
  if(count GREATER 0)
    foreach(number RANGE ${last})
      set(batch ${CMAKE_CURRENT_BINARY_DIR}/${target}_${number}.cpp)
      file(CONFIGURE OUTPUT ${batch} CONTENT "${text_${number}}" @ONLY)
      list(APPEND compiled ${batch})
    endforeach()
  endif()
  set_property(TARGET ${target} PROPERTY SOURCES ${compiled})
endfunction()

# talus_test(NAME LABEL sources... [TOGETHER] [ALONE sources...] [CHOSEN cases...] [TIMEOUT s] [LINK libraries...]): adds a
# GoogleTest program whose cases are tests of ctest. The target LABEL_tests builds all programs of a label.
#   ALONE     sources that are compiled by themselves, because their local names clash with those of other sources
#   CHOSEN    cases, as GoogleTest filters, with the label LABEL_chosen: `./bootstrap test` runs them
#   TOGETHER  makes all cases one test of ctest, because each takes less time than the start of a process, or because they share
#             a bed. With AddressSanitizer, whose processes start slowly, this applies to every program
function(talus_test name label)
  cmake_parse_arguments(TEST "TOGETHER" "TIMEOUT" "ALONE;LINK;CHOSEN" ${ARGN})
  if(NOT TEST_TIMEOUT)
    set(TEST_TIMEOUT 120)
  endif()
  add_executable(${name} ${TEST_UNPARSED_ARGUMENTS} ${TEST_ALONE})
  set_source_files_properties(${TEST_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  target_link_libraries(${name} PRIVATE ${TEST_LINK} talus_test_options GTest::gtest_main)
  target_precompile_headers(${name} REUSE_FROM talus_test_headers)
  if(TALUS_JOIN)
    talus_join_sources(${name})
  endif()
  if(NOT TARGET ${label}_tests)
    add_custom_target(${label}_tests)
  endif()
  add_dependencies(${label}_tests ${name})
  if(TALUS_SANITIZE OR CMAKE_CXX_FLAGS_RELWITHDEBINFO MATCHES "-fsanitize")
    math(EXPR TEST_TIMEOUT "5 * ${TEST_TIMEOUT}")
  endif()
  if(TEST_TOGETHER OR TALUS_SANITIZE)
    math(EXPR TEST_TIMEOUT "3 * ${TEST_TIMEOUT}") # of all cases
    add_test(NAME ${name} COMMAND ${name})
    # These take longest and therefore start first.
    set_tests_properties(${name} PROPERTIES LABELS ${label} TIMEOUT ${TEST_TIMEOUT} COST 50)
  elseif(TEST_CHOSEN)
    list(JOIN TEST_CHOSEN ":" chosen)
    gtest_discover_tests(${name} TEST_FILTER "${chosen}" TEST_LIST ${name}_chosen DISCOVERY_TIMEOUT 60
      PROPERTIES LABELS ${label}_chosen TIMEOUT ${TEST_TIMEOUT})
    gtest_discover_tests(${name} TEST_FILTER "-${chosen}" TEST_LIST ${name}_others DISCOVERY_TIMEOUT 60
      PROPERTIES LABELS ${label} TIMEOUT ${TEST_TIMEOUT})
  else()
    gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES LABELS ${label} TIMEOUT ${TEST_TIMEOUT})
  endif()
endfunction()
