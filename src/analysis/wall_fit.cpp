#include "analysis/wall_fit.h"

#include <cmath>
#include <limits>

namespace talus {

double wall_law(double k, double depth_over_length) { return 1.0 - k / 3.0 * depth_over_length; }

WallFit fit_wall_law(std::span<const WallPoint> points) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double xx = 0.0, xy = 0.0;
  for (const auto& [x, ratio] : points) {
    xx += x * x;
    xy += x * (1.0 - ratio);
  }
  if (points.empty()) return {none, none};
  WallFit fit{3.0 * xy / xx, none};
  if (points.size() < 2) return fit;
  double squares = 0.0;
  for (const auto& [x, ratio] : points) {
    const double residual = ratio - wall_law(fit.k, x);
    squares += residual * residual;
  }
  fit.error = 3.0 * std::sqrt(squares / static_cast<double>(points.size() - 1) / xx);
  return fit;
}

}  // namespace talus
