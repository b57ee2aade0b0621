# What most sources include, read by the compiler once: for each room that is added from here on. Those of the mechanics
# stand before, as some of their sources have flags of their own. CMAKE_DISABLE_PRECOMPILE_HEADERS does without.
set(TALUS_HEADERS <algorithm> <array> <cmath> <cstddef> <cstdint> <cstdio> <filesystem> <functional> <limits> <memory>
  <optional> <span> <string> <string_view> <utility> <vector> <fmt/core.h>)
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/precompiled.cpp CONTENT "// The headers alone.\n")
add_library(talus_headers OBJECT ${CMAKE_BINARY_DIR}/generated/precompiled.cpp)
target_link_libraries(talus_headers PRIVATE talus_core)
target_precompile_headers(talus_headers PRIVATE ${TALUS_HEADERS})
