#pragma once
/// Colour maps: from a share of a range to a colour.

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "render/colour.h"

namespace talus::render {

enum class ColourMap {
  gray,       ///< white to black, as the paper's maps
  viridis,    ///< dark violet to yellow; lightness grows evenly, also for the colour-blind
  cividis,    ///< dark blue to yellow, the same for red-green blindness (Nunez et al. 2018)
  magma,      ///< black over purple to cream
  inferno,    ///< black over red to pale yellow
  plasma,     ///< blue over magenta to yellow
  diverging,  ///< dark blue over white to orange; white at one half, the two ends of different lightness
  // The same from the other end.
  gray_r,
  viridis_r,
  cividis_r,
  magma_r,
  inferno_r,
  plasma_r,
  diverging_r,
};

/// Those that are not reversed, in the order in which users see them listed.
std::span<const ColourMap> colour_maps();

/// viridis_r of viridis, and viridis of viridis_r.
ColourMap reversed(ColourMap map);
bool is_reversed(ColourMap map);
/// viridis of either.
ColourMap one_way(ColourMap map);

/// "viridis", "viridis_r".
std::string_view colour_map_name(ColourMap map);
/// The map of a name; none if no map has it.
std::optional<ColourMap> colour_map(std::string_view name);

/// The colour at a share of the range, clamped to [0, 1]; for NaN that of the lower end.
Colour colour_at(ColourMap map, double share);

/// The map from end to end in 256 steps, for a colour bar.
std::vector<Colour> colour_ramp(ColourMap map);

}  // namespace talus::render
