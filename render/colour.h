#pragma once
/// Colours of pictures.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

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

/// Colour maps: they assign a colour to each position in a range.
enum class ColourMap {
  gray,       ///< white to black, as in the paper's maps
  viridis,    ///< dark violet to yellow; lightness increases evenly, also for colour-blind readers
  cividis,    ///< dark blue to yellow, optimised for red-green colour blindness (Nunez et al. 2018)
  magma,      ///< black through purple to cream
  inferno,    ///< black through red to pale yellow
  plasma,     ///< blue through magenta to yellow
  diverging,  ///< dark blue through white to orange; white is at one half, and the ends differ in lightness
  // The reversed maps.
  gray_r,
  viridis_r,
  cividis_r,
  magma_r,
  inferno_r,
  plasma_r,
  diverging_r,
};

/// Returns the maps that are not reversed, in the order in which they are listed to users.
std::span<const ColourMap> colour_maps();

/// Returns the reversed map: viridis_r for viridis, and viridis for viridis_r.
ColourMap reversed(ColourMap map);
bool is_reversed(ColourMap map);
/// Returns the map that is not reversed: viridis for viridis and for viridis_r.
ColourMap one_way(ColourMap map);

/// Returns the name, such as "viridis" or "viridis_r".
std::string_view colour_map_name(ColourMap map);
/// Returns the map of a name, or nothing if the name is unknown.
std::optional<ColourMap> colour_map(std::string_view name);

/// Returns the colour at a position in the range, clamped to [0, 1]; NaN gives the colour of the lower end.
Colour colour_at(ColourMap map, double share);

/// Returns 256 colours from the lower to the upper end, for a colour bar.
std::vector<Colour> colour_ramp(ColourMap map);

}  // namespace talus::render
