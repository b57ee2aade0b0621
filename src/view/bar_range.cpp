#include "view/bar_range.h"

#include <algorithm>
#include <cmath>

namespace talus::view {
namespace {

constexpr double min_share = 0.02;  // minimum width of the new range, as a share of the old one

/// Rounds to hundredths of the power of ten of the range or, on a logarithmic bar, of the value.
double rounded(double value, const BarEnds& bar) {
  const double size = bar.logarithmic ? std::abs(value) : bar.high - bar.low;
  const double decimals = 2.0 - std::floor(std::log10(size));
  const double scale = std::pow(10.0, std::abs(decimals));  // a whole number, so that the division is exact
  return decimals < 0.0 ? scale * std::round(value / scale) : std::round(value * scale) / scale;
}

}  // namespace

double value_at(const BarEnds& bar, double share) {
  if (bar.logarithmic) return bar.low * std::pow(bar.high / bar.low, share);
  return bar.low + share * (bar.high - bar.low);
}

std::array<double, 2> pulled(const HeldBar& held, double share) {
  double low = 0.0, high = 1.0;  // as shares of the previous bar
  switch (held.part) {
    case HeldBar::Part::low:
      low = std::min(share, 1.0 - min_share);
      break;
    case HeldBar::Part::high:
      high = std::max(1.0 + share, min_share);
      break;
    case HeldBar::Part::middle:
      low = -share;
      high = 1.0 - share;
      break;
    case HeldBar::Part::none:
      break;
  }
  const BarEnds& bar = held.before;
  return {low == 0.0 ? bar.low : rounded(value_at(bar, low), bar),
          high == 1.0 ? bar.high : rounded(value_at(bar, high), bar)};
}

}  // namespace talus::view
