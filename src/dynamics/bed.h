#pragma once
/// The bed before it falls: a loose random arrangement above its floor.

#include <cstdint>

#include "core/world.h"

namespace talus {

/// What a bed is made of. Lengths in m.
struct BedPlan {
  double mean_diameter = 0.01;
  double size_ratio = 1.5;  ///< Dmax / Dmin; diameters are uniform in [Dmin, Dmax] with the mean given
  double density = 2500.0;  ///< kg/m^3
  double length = 2.0;      ///< period, or distance between the walls
  Index grain_count = 8000;
  bool periodic = true;
  bool rough_floor = true;  ///< glued grains of the mean diameter, their tops at y = 0; else the plane y = 0
  double initial_solid_fraction = 0.5;  ///< of the loose arrangement
  std::uint64_t seed = 1;
};

/// Largest solid fraction that the loose arrangement can have for a size ratio: one grain in each square cell
/// as wide as the largest grain.
double largest_initial_solid_fraction(double size_ratio);

/// The world of a plan: grains at rest, one in each cell of a square lattice, at a random place within its
/// cell, with ids that grow from the floor upwards. The same for the same plan, everywhere.
World make_bed(const BedPlan& plan);

}  // namespace talus
