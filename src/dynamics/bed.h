#pragma once
/// What a bed is made of: the sizes of its grains, its floor, what bounds it. How the grains get into it is a
/// file of its own for each method: collapse.h, pour.h, geometric.h.

#include <cstdint>

#include "core/random.h"
#include "core/world.h"

namespace talus::dynamics {

/// What a bed is made of. Lengths in m.
struct BedPlan {
  double mean_diameter = 0.01;
  double size_ratio = 1.5;  ///< Dmax / Dmin; diameters are uniform in [Dmin, Dmax] with the mean given
  double density = 2500.0;  ///< kg/m^3
  double length = 2.0;      ///< period, or distance between the walls
  Index grain_count = 8000;
  bool periodic = true;
  bool rough_floor = true;  ///< glued grains of the mean diameter, their tops at y = 0; else the plane y = 0
  std::uint64_t seed = 1;
};

/// Diameter of the smallest and of the largest grain, m.
double smallest_diameter(const BedPlan& plan);
double largest_diameter(const BedPlan& plan);

/// The radius of the next grain, m.
double random_radius(const BedPlan& plan, Random& random);

/// <d^2> / <d>^2 of the diameters: 1 + (Dmax - Dmin)^2 / (12 D^2).
double mean_square_ratio(double size_ratio);

/// The world of a plan without grains: side walls or a period.
World empty_bed(const BedPlan& plan);

/// Adds the floor, which closes the list of free grains: glued grains side by side, or a plane.
void add_floor(const BedPlan& plan, World& world);

}  // namespace talus::dynamics
