#pragma once
/// The cell of each grain, and the share of it that the grain fills.

#include <vector>

#include "analysis/record.h"
#include "core/bed_frame.h"

namespace talus::analysis {

/// How far cells reach: to a power |x - x_i|^2 - r_i^2 of this times D^2, the hole in a ring of six grains of
/// diameter D. What is farther from all grains is not in the bed, but above it.
inline constexpr double largest_power = 0.75;

/// The cell of a grain in the radical (power, Laguerre) diagram of the disks: the points of lower power to it
/// than to any other grain. Unlike cells of points, those of disks of different sizes cut no disk. Walls, and
/// a smooth floor, are edges; so are the cells of the grains of a floor. (T30)
struct GrainCell {
  std::vector<Vec2> corners;  ///< m, counter-clockwise; of an open one beyond the largest power as well
  bool is_open = false;       ///< it reaches beyond the largest power: the grain is at the free surface

  double area() const;  ///< m^2
};

/// Of each free grain. Of periodic images the nearest counts.
std::vector<GrainCell> grain_cells(const BedFrame& bed);

/// Area of each free grain over that of its cell; NaN where the cell is open.
std::vector<double> local_solid_fractions(const BedFrame& bed);

/// Sets members of a record, defined in the table of quantities.
void take_local_solid_fraction(const BedFrame& bed, FrameRecord& record);

}  // namespace talus::analysis
