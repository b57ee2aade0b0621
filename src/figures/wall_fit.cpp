#include "figures/wall_fit.h"

#include <cmath>

#include "core/tensor.h"

namespace talus::figures {

double wall_law(double k, double depth_over_length) { return 1.0 - k / 3.0 * depth_over_length; }

WallFit fit_wall_law(std::span<const WallPoint> points) {
  if (points.empty()) return {not_known, not_known};
  const auto count = static_cast<Eigen::Index>(points.size());
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>> data(
      &points.front().depth_over_length, count, 2);
  const Eigen::VectorXd x = data.col(0), ratio = data.col(1), loss = 1.0 - ratio.array();
  const double k = 3.0 * x.dot(loss) / x.squaredNorm();
  if (count < 2) return {k, not_known};
  const Eigen::VectorXd residual = ratio - x.unaryExpr([k](double each) { return wall_law(k, each); });
  return {k, 3.0 * std::sqrt(residual.squaredNorm() / static_cast<double>(count - 1) / x.squaredNorm())};
}

}  // namespace talus::figures
