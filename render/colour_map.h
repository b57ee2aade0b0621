#pragma once
/// Colour maps: from a share of a range to a colour.

#include <span>
#include <string_view>
#include <vector>

#include "render/colour.h"

namespace talus::render {

enum class ColourMap {
  gray,       ///< white to black, as the paper's maps
  viridis,    ///< dark violet to yellow; lightness grows evenly, also for the colour-blind
  cividis,    ///< dark blue to yellow, the same for red-green blindness (Nunez et al. 2018)
  diverging,  ///< dark blue over white to orange; white at one half, the two ends of different lightness
};

/// All of them, in the order in which users see them listed.
std::span<const ColourMap> colour_maps();

/// "viridis". The map of a name; throws Error(usage) with the names that exist.
std::string_view colour_map_name(ColourMap map);
ColourMap colour_map(std::string_view name);

/// The colour at a share of the range, clamped to [0, 1]; for NaN that of the lower end.
Colour colour_at(ColourMap map, double share);

/// The map from end to end in 256 steps, for a colour bar.
std::vector<Colour> colour_ramp(ColourMap map);

}  // namespace talus::render
