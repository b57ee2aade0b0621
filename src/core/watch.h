#pragma once
/// Who watches what takes long.

#include <cstddef>
#include <functional>

namespace talus {

/// Called with how many are done, and how many there are in all; may be empty.
using CountDone = std::function<void(std::size_t done, std::size_t count)>;

struct Watch {
  CountDone progress;             ///< may be empty
  std::function<bool()> stopped;  ///< whether to stop; asked before each of them
};

}  // namespace talus
