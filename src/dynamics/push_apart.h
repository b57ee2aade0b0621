#pragma once
/// Grains that overlap are moved apart, without forces: beds of soft grains become beds of rigid ones.

#include "core/world.h"

namespace talus::dynamics {

/// How far grains were moved, m.
struct Displacement {
  double mean = 0.0, largest = 0.0;
};

/// Moves free grains along the normals of their overlaps until none is deeper than `allowed` (m): two grains
/// by half of it each, one at the floor or a wall by all of it, contact by contact in the order of their
/// keys, so that the result is the same everywhere. Velocities and the memory of contacts stay as they are.
/// Ends after a fixed number of sweeps, whether or not that was reached.
Displacement push_apart(World& world, double allowed);

}  // namespace talus::dynamics
