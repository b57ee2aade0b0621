#pragma once
/// Colours of pictures.

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace talus::render {

/// An 8-bit sRGB colour with straight alpha, as stored in pictures.
struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0, alpha = 255;
  bool operator==(const Colour&) const = default;
};

inline constexpr Colour white{255, 255, 255, 255};
inline constexpr Colour black{0, 0, 0, 255};

/// Returns the gray of a shade from 0 (white) to 1 (black).
inline Colour gray(double shade) {
  const auto value = static_cast<std::uint8_t>(std::lround(255.0 * (1.0 - std::clamp(shade, 0.0, 1.0))));
  return {value, value, value, 255};
}

inline bool is_gray(const Colour& colour) {
  return colour.red == colour.green && colour.green == colour.blue;
}

/// Returns the luma of a colour (Rec. 601), 0 ... 255: its lightness in a gray print.
inline double luma(const Colour& colour) {
  return 0.299 * colour.red + 0.587 * colour.green + 0.114 * colour.blue;
}

}  // namespace talus::render
