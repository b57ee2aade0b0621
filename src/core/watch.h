#pragma once
/// Callbacks for progress and interruption of long operations.

#include <cstddef>
#include <functional>

namespace talus {

/// Callback with the number of finished items and the total; may be empty.
using CountDone = std::function<void(std::size_t done, std::size_t count)>;

struct Watch {
  CountDone progress;             ///< may be empty
  std::function<bool()> stopped;  ///< whether to stop; called before each item
};

}  // namespace talus
