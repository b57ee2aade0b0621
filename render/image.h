#pragma once
/// A picture in memory.

#include <cstdint>
#include <vector>

namespace talus {

/// 8-bit gray, rows from top to bottom, 0 black, 255 white.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> gray;  ///< width * height
};

}  // namespace talus
