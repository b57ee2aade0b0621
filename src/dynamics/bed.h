#pragma once
/// The plan of a bed: sizes of its grains, floor, and boundary. Each method of deposition has its own file:
/// collapse.h, pour.h, geometric.h.

#include <cstdint>

#include "core/random.h"
#include "core/world.h"

namespace talus::dynamics {

/// Plan of a bed. Lengths are in m.
struct BedPlan {
  double mean_diameter = 0.01;
  double size_ratio = 1.5;  ///< Dmax / Dmin; diameters are uniform in [Dmin, Dmax]
  double density = 2500.0;  ///< kg/m^3
  double length = 2.0;      ///< period, or distance between the walls
  Index grain_count = 8000;
  bool periodic = true;
  bool rough_floor =
      true;  ///< glued grains of the mean diameter with their tops at y = 0; else the plane y = 0
  std::uint64_t seed = 1;
};

/// Return the diameters of the smallest and of the largest grain, m.
double smallest_diameter(const BedPlan& plan);
double largest_diameter(const BedPlan& plan);

/// Draws the radius of the next grain, m.
double random_radius(const BedPlan& plan, Random& random);

/// Returns <d^2> / <d>^2 of the diameters, 1 + (Dmax - Dmin)^2 / (12 D^2).
double mean_square_ratio(double size_ratio);

/// Returns the world of a plan without grains, with side walls or a period.
World empty_bed(const BedPlan& plan);

/// Adds the floor: a row of glued grains, or a plane. No free grain can be added afterwards.
void add_floor(const BedPlan& plan, World& world);

}  // namespace talus::dynamics
