#pragma once
/// Range of a colour bar, changed by dragging with the mouse.

#include <array>

namespace talus::view {

/// Ends of a bar.
struct BarEnds {
  double low = 0.0, high = 1.0;
  bool logarithmic = false;  ///< requires 0 < low
};

/// Returns the value at a share of the bar's length; the share may lie beyond the ends.
double value_at(const BarEnds& bar, double share);

/// Part of a bar that is being dragged, and the state of the bar when the drag began.
struct HeldBar {
  enum class Part { none, low, high, middle };
  Part part = Part::none;
  BarEnds before;
  double from = 0.0;  ///< position of the mouse at the beginning, px
};

/// Returns the ends after the dragged part has moved by a share of the bar's length. Pulling an end outwards
/// widens the range; pulling the middle moves both ends. The ends are rounded to what a pixel can resolve and
/// stay apart.
std::array<double, 2> pulled(const HeldBar& held, double share);

}  // namespace talus::view
