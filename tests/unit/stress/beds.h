#pragma once
/// Beds made grain by grain.

#include "core/world.h"

namespace talus::test {

constexpr double unit_radius = 0.5;  ///< m; the mean diameter is 1

inline World empty_bed(double length, bool periodic) {
  World world;
  world.boundary.periodic = periodic;
  world.boundary.length = length;
  return world;
}

inline void add_grain(World& world, double x, double y, double radius = unit_radius, bool fixed = false) {
  add_disk(world.grains, {x, y}, radius, 1.0, fixed);
}

}  // namespace talus::test
