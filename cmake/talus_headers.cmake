# Common headers, precompiled for all rooms that are added after this file is included. These rooms compute little and
# are compiled with -O1 in the release build. CMAKE_DISABLE_PRECOMPILE_HEADERS switches precompilation off.
# At -O1 gcc falsely reports values of std::optional as uninitialised.
set(TALUS_ROOM_OPTIONS $<$<CONFIG:Release>:-O1> $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
set(TALUS_HEADERS <algorithm> <array> <charconv> <chrono> <cmath> <cstddef> <cstdint> <cstdio> <cstring> <filesystem>
  <fstream> <functional> <iterator> <limits> <map> <memory> <numbers> <numeric> <optional> <ranges> <set> <span>
  <sstream> <string> <string_view> <tuple> <utility> <variant> <vector> <Eigen/Core> <fmt/core.h>)
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/precompiled.cpp CONTENT "// The headers alone.\n")
add_library(talus_headers OBJECT ${CMAKE_BINARY_DIR}/generated/precompiled.cpp)
target_link_libraries(talus_headers PRIVATE talus_core)
set_target_properties(talus_headers PROPERTIES POSITION_INDEPENDENT_CODE ON) # as for the rooms
target_compile_options(talus_headers PRIVATE ${TALUS_ROOM_OPTIONS})
target_precompile_headers(talus_headers PRIVATE ${TALUS_HEADERS})
