#pragma once
/// The range of a bar, as it is pulled with the mouse.

#include <array>

namespace talus::view {

/// The ends of a bar.
struct BarEnds {
  double low = 0.0, high = 1.0;
  bool logarithmic = false;  ///< then 0 < low
};

/// The value at a share of a bar, also beyond its ends.
double value_at(const BarEnds& bar, double share);

/// What of a bar is held, and how it was as that began.
struct HeldBar {
  enum class Part { none, low, high, middle };
  Part part = Part::none;
  BarEnds before;
  double from = 0.0;  ///< where the mouse was, px
};

/// The ends after the held part has been moved by a share of the length of the bar: an end that is pulled
/// outwards makes the range wider, the middle moves both ends. They are rounded to what a pixel can tell, and
/// stay apart.
std::array<double, 2> pulled(const HeldBar& held, double share);

}  // namespace talus::view
