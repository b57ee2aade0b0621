#pragma once
/// The boundary of the grains: a periodic direction, and planes.

#include <cmath>
#include <vector>

#include "core/types.h"

namespace talus {

/// A fixed plane (a line in two dimensions): the half space { r : n.r >= offset } is free.
struct Plane {
  Vec2 normal;          ///< unit, into the free space
  double offset = 0.0;  ///< m
  bool wall = true;     ///< side wall, with the friction of walls; else a smooth floor, with that of grains
};

/// The boundary of a bed. In contact records, plane k has the body id grains.count() + k.
struct Boundary {
  bool periodic = false;  ///< periodic along x, with period `length`
  double length = 0.0;    ///< m: period, or distance between the side walls
  std::vector<Plane> planes;
};

/// Returns the offset from one position along the bed to another, m; in a periodic bed the shorter one.
inline double offset_along(const Boundary& boundary, double from, double to) {
  const double offset = to - from;
  return boundary.periodic ? std::remainder(offset, boundary.length) : offset;
}

}  // namespace talus
