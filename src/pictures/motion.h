#pragma once
/// How far grains have moved and turned, and the ranges of scales that fit that.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pictures/maps.h"

namespace talus {

/// What displacements and rotations are measured over.
struct MotionSpan {
  bool per_degree = false;
  double degrees = 1.0;  ///< what they are divided by
  std::string title;     ///< " since 5.00°"
  std::string unit;      ///< " per degree"
};
MotionSpan motion_span(const MapFrame& of);

/// Of each free grain in D, or D per degree, across a periodic edge where it went through one; 0 without a
/// reference.
std::vector<Vec2> displacements(const MapFrame& of, const MotionSpan& span);

/// Of each free grain in degrees, or degrees per degree, counter-clockwise positive; 0 without a reference.
std::vector<double> rotations(const MapFrame& of, const MotionSpan& span);

/// Numbers of values >= 0 in narrow classes: quantiles of any number of values in little memory.
class LogHistogram {
 public:
  void add(double value);
  /// The value that `share` of those added lie below, 2.4 % too large at most; those below 1e-9 count as 0.
  double quantile(double share) const;

 private:
  static constexpr int decades = 18, classes_per_decade = 100;
  static constexpr double smallest = 1e-9;
  std::array<std::int64_t, decades * classes_per_decade + 1> counts_{};
  std::int64_t total_ = 0;
};

/// Meets the frames that are drawn, and finds the ranges that fit them.
class MotionSample {
 public:
  /// A frame with its reference; one without adds nothing.
  void add(const MapFrame& of);
  MotionRanges ranges() const;

 private:
  std::array<LogHistogram, 2> displacement_, rotation_;  ///< in all, and per degree
};

}  // namespace talus
