#pragma once
/// Motion of each grain between two frames, and the ranges of scales that fit it.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "pictures/maps.h"

namespace talus::pictures {

/// The interval over which motion is measured.
struct MotionSpan {
  bool per_degree = false;
  double degrees = 1.0;  ///< divisor
  std::string title;     ///< for example " since 5.00°"
  std::string unit;      ///< for example " per degree"
};
MotionSpan motion_span(const MapFrame& bed);

/// Counts of non-negative values in narrow classes, which give quantiles of any number of values in little
/// memory.
class LogHistogram {
 public:
  /// Makes an empty histogram; values below `smallest` count as 0.
  explicit LogHistogram(double smallest = 1e-9) : smallest_(smallest) {}
  void add(double value);
  /// Returns the value below which a fraction `share` of the values lies, at most 2.4 % too large.
  double quantile(double share) const;

 private:
  static constexpr int decades = 18, classes_per_decade = 100;
  double smallest_;
  std::array<std::int64_t, decades * classes_per_decade + 1> counts_{};
  std::int64_t total_ = 0;
};

/// Collects the frames that are drawn, and finds the ranges that fit them.
class MotionSample {
 public:
  /// Makes an empty sample for these maps of motion (fits_frames), drawn with these settings.
  explicit MotionSample(const MapLayers& maps, const MapSettings& settings = {});
  /// Adds a frame with its reference; one without a reference adds only velocities.
  void add(const MapFrame& bed);
  MotionRanges ranges() const;

 private:
  MapSettings settings_;
  std::map<MapKind, std::array<LogHistogram, 2>> sizes_;  ///< total, and per degree
};

}  // namespace talus::pictures
