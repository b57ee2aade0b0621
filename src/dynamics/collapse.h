#pragma once
/// Deposition by collapse: all grains fall simultaneously from a loose random arrangement. The resulting beds
/// are loose, and contract during the tilt (docs/preparation.md).

#include "dynamics/bed.h"

namespace talus::dynamics {

/// Returns the largest solid fraction of the loose arrangement for a size ratio: one grain in each square
/// cell as wide as the largest grain.
double largest_initial_solid_fraction(double size_ratio);

/// Returns a bed of grains at rest above the floor, one at a random position in each cell of a square
/// lattice, with ids that increase from the floor upwards. The solid fraction is `initial_solid_fraction`, or
/// less if the size ratio requires it. The same plan gives the same bed on every platform.
World make_loose_bed(const BedPlan& plan, double initial_solid_fraction = 0.5);

}  // namespace talus::dynamics
