#pragma once
/// Geometric removal of overlaps, which turns beds of soft grains into beds of rigid ones.

#include "core/world.h"

namespace talus::dynamics {

/// Displacements of the grains, m.
struct Displacement {
  double mean = 0.0, largest = 0.0;
};

/// Moves free grains along the normals of their overlaps until no overlap is deeper than `allowed` (m): two
/// grains by half of the overlap each, a grain at the floor or a wall by all of it. Contacts are processed in
/// the order of their keys, so that the result is the same on every platform. Velocities and contact memory
/// do not change. Ends after a fixed number of sweeps, even if a deeper overlap remains.
Displacement push_apart(World& world, double allowed);

}  // namespace talus::dynamics
