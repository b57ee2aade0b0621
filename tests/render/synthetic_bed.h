#pragma once
/// A made-up bed for pictures: grains on a triangular lattice above a floor, with stress ratios that vary in
/// space.

#include <cmath>
#include <limits>

#include "core/random.h"
#include "core/snapshot.h"

namespace talus::test {

struct SyntheticBed {
  RunStatics statics;
  Frame frame;
};

/// `columns` x `rows` free grains of mean diameter 1 cm, and one row of floor grains.
inline SyntheticBed make_synthetic_bed(int columns, int rows, bool periodic = true) {
  constexpr double diameter = 0.01;
  SyntheticBed bed;
  bed.statics.periodic = periodic;
  bed.statics.length = columns * diameter;
  bed.statics.depth = rows * diameter;
  bed.statics.mean_diameter = diameter;
  bed.frame.tilt = 0.2;
  Random random(7);
  const auto add = [&](double x, double y, double radius, double gamma) {
    bed.frame.x.push_back(x);
    bed.frame.y.push_back(y);
    bed.statics.radius.push_back(radius);
    bed.frame.gamma.push_back(gamma);
  };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double x = (column + (row % 2 ? 0.5 : 0.0)) * diameter;
      const double y = (0.5 + row * std::sqrt(0.75)) * diameter;
      const double pattern = std::sin(0.09 * column + 0.2 * row) * std::sin(0.05 * column - 0.13 * row);
      const double gamma = 0.35 + 0.3 * pattern + random.uniform(-0.25, 0.25);
      const bool carries = random.uniform() > 0.05;
      add(x, y, random.uniform(0.4, 0.5) * diameter,
          carries ? std::max(0.0, gamma) : std::numeric_limits<double>::quiet_NaN());
    }
  bed.statics.free_count = static_cast<Index>(bed.frame.x.size());
  for (int column = 0; column < columns; ++column)
    add((column + 0.5) * diameter, -0.5 * diameter, 0.5 * diameter, std::numeric_limits<double>::quiet_NaN());
  return bed;
}

}  // namespace talus::test
