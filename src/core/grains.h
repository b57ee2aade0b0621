#pragma once
/// The grains: disks in structure-of-arrays form, grouped by frequency of access.

#include <vector>

#include "core/types.h"

namespace talus {

/// Disks by their stable ids: the free grains come first (0 ... free_count - 1), then the grains glued to the
/// floor, which never move. All quantities are per metre of thickness.
struct Grains {
  Index free_count = 0;

  // Read and written in each step.
  std::vector<double> x, y;    ///< centre, m; in a periodic bed x lies in [0, length)
  std::vector<double> vx, vy;  ///< velocity, m/s
  std::vector<double> omega;   ///< rotation velocity, rad/s, counter-clockwise positive

  // Read in each step.
  std::vector<double> radius;           ///< m
  std::vector<double> inverse_mass;     ///< 1/kg; 0 for a grain that does not move
  std::vector<double> inverse_inertia;  ///< 1/(kg m^2); 0 for a grain that does not rotate

  // Read by output and analysis.
  std::vector<double> mass;     ///< kg
  std::vector<double> inertia;  ///< kg m^2, about the centre; m r^2 / 2
  std::vector<double> angle;    ///< rad, rotation since the beginning, counter-clockwise positive
  std::vector<Index> image;  ///< number of exits through the right periodic edge minus those through the left

  Index count() const { return static_cast<Index>(radius.size()); }
};

/// Reserves memory for `count` grains; up to this number the arrays are not moved.
void reserve(Grains& grains, std::size_t count);

/// Appends a disk at rest and returns its id. A free grain must not follow a floor grain. `density` is in
/// kg/m^3; a fixed disk has the mass of its size, but the inverse mass 0.
Index add_disk(Grains& grains, Vec2 centre, double radius, double density, bool fixed);

}  // namespace talus
