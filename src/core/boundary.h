#pragma once
/// What surrounds the grains: a periodic direction, planes.

#include <cmath>
#include <vector>

#include "core/types.h"

namespace talus {

/// A fixed plane (a line in two dimensions): the half space { r : n.r >= offset } is free.
struct Plane {
  Vec2 normal;          ///< unit, into the free space
  double offset = 0.0;  ///< m
  bool wall = true;     ///< a side wall, with the friction of walls; else a smooth floor, with that of grains
};

/// In contact records, plane k has the body id grains.count() + k.
struct Boundary {
  bool periodic = false;  ///< along x, with period `length`
  double length = 0.0;    ///< m: period, or distance between the side walls
  std::vector<Plane> planes;
};

/// From one place along the bed to another, m; the shortest way around a periodic one.
inline double offset_along(const Boundary& boundary, double from, double to) {
  const double offset = to - from;
  return boundary.periodic ? std::remainder(offset, boundary.length) : offset;
}

}  // namespace talus
