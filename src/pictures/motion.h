#pragma once
/// What happened between two frames, of each grain, and the ranges of scales that fit that.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "pictures/maps.h"

namespace talus::pictures {

/// What motion is measured over.
struct MotionSpan {
  bool per_degree = false;
  double degrees = 1.0;  ///< what it is divided by
  std::string title;     ///< " since 5.00°"
  std::string unit;      ///< " per degree"
};
MotionSpan motion_span(const MapFrame& of);

/// Numbers of values >= 0 in narrow classes: quantiles of any number of values in little memory.
class LogHistogram {
 public:
  /// Values below `smallest` count as 0.
  explicit LogHistogram(double smallest = 1e-9) : smallest_(smallest) {}
  void add(double value);
  /// The value that `share` of those added lie below, 2.4 % too large at most.
  double quantile(double share) const;

 private:
  static constexpr int decades = 18, classes_per_decade = 100;
  double smallest_;
  std::array<std::int64_t, decades * classes_per_decade + 1> counts_{};
  std::int64_t total_ = 0;
};

/// Meets the frames that are drawn, and finds the ranges that fit them.
class MotionSample {
 public:
  /// For these maps of motion (fits_frames), drawn with these settings.
  explicit MotionSample(const MapLayers& maps, const MapSettings& settings = {});
  /// A frame with its reference; one without adds velocities alone.
  void add(const MapFrame& of);
  MotionRanges ranges() const;

 private:
  MapSettings settings_;
  std::map<MapKind, std::array<LogHistogram, 2>> sizes_;  ///< in all, and per degree
};

}  // namespace talus::pictures
