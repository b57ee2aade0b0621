#pragma once
/// Deposition by collapse: all grains fall at once from a loose random arrangement. Its beds are loose, and
/// contract under the tilt (docs/preparation.md).

#include "dynamics/bed.h"

namespace talus::dynamics {

/// Largest solid fraction that the loose arrangement can have for a size ratio: one grain in each square cell
/// as wide as the largest grain.
double largest_initial_solid_fraction(double size_ratio);

/// Grains at rest above the floor, one in each cell of a square lattice, at a random place within its cell,
/// with ids that grow from the floor upwards; less than `initial_solid_fraction` where the size ratio needs
/// room. The same for the same plan, everywhere.
World make_loose_bed(const BedPlan& plan, double initial_solid_fraction = 0.5);

}  // namespace talus::dynamics
