#pragma once
/// Bounds of a bed that can be stored: code that reads a run uses its values as sizes of grids and indices.
/// Reader and writer of runs apply the same.

#include <algorithm>

#include "core/bed_frame.h"

namespace talus::io {

/// Whether what is written is checked; only tests that make invalid runs clear it.
inline bool checks_what_is_written = true;

/// Radii of grains, mean diameters.
inline constexpr double smallest_radius = 1e-3, largest_radius = 1e3;

/// Returns the largest valid distance of a grain or contact from the origin along either axis, m. Divided
/// into cells of the size of a grain, it must still be a valid number of cells.
inline double farthest_place(double length, double depth, double mean_diameter) {
  return std::min(1e4 * (length + depth), 1e8 * mean_diameter);
}
inline double farthest_place(const RunStatics& statics) {
  return farthest_place(statics.length, statics.depth, statics.mean_diameter);
}

}  // namespace talus::io
