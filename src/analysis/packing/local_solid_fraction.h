#pragma once
/// Radical cells of the grains and local solid fractions.

#include <vector>

#include "analysis/record.h"
#include "core/bed_frame.h"

namespace talus::analysis {

/// Largest power |x - x_i|^2 - r_i^2 of a point in a cell, in D^2: that of the hole in a ring of six grains
/// of diameter D. Points of larger power to all grains lie above the bed.
inline constexpr double largest_power = 0.75;

/// The cell of a grain in the radical (power, Laguerre) diagram of the disks: the points whose power to this
/// grain is lower than to any other. Unlike Voronoi cells of the centres, radical cells never cut a disk of a
/// different size. Walls and a smooth floor bound the cells, as do the cells of floor grains. (T30)
struct GrainCell {
  /// Corners, m, counter-clockwise; those of an open cell may lie beyond the largest power.
  std::vector<Vec2> corners;
  bool is_open = false;  ///< whether it extends beyond the largest power: the grain is at the free surface

  double area() const;  ///< m^2
};

/// Returns the cell of each free grain. Only the nearest periodic image of a neighbour counts.
std::vector<GrainCell> grain_cells(const BedFrame& bed);

/// Returns the area of each free grain over that of its cell; NaN if the cell is open.
std::vector<double> local_solid_fractions(const BedFrame& bed);

/// Sets members of a record that are defined in the table of quantities.
void measure_local_solid_fraction(const BedFrame& bed, FrameRecord& record);

}  // namespace talus::analysis
