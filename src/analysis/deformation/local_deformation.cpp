#include "analysis/deformation/local_deformation.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "analysis/cells.h"
#include "analysis/free_grains.h"
#include "core/tensor_inverse.h"

namespace talus::analysis {
namespace {

/// Returns the displacements of all grains between two frames, m, unwrapped along x.
std::vector<Vector2> displacements(const Frame& before, const BedFrame& bed) {
  std::vector<Vector2> moved;
  for (Index i = 0; i < bed.frame.grain_count(); ++i) {
    const Vec2 by = displacement(bed, before, i);
    moved.emplace_back(by.x, by.y);
  }
  return moved;
}

/// Sums over neighbours of positions d and displacements u relative to the grain.
struct Fit {
  Matrix2 dd = Matrix2::Zero(), ud = Matrix2::Zero();
  double uu = 0.0;
  Index count = 0;

  void add(const Vector2& d, const Vector2& u) {
    dd += d * d.transpose();
    ud += u * d.transpose();
    uu += u.squaredNorm();
    ++count;
  }
};

LocalDeformation fitted(const Fit& fit) {
  constexpr double flat = 1e-6;  // smallest det over (trace / 2)^2 of points that do not lie in one line
  if (fit.count < 2 || fit.dd.determinant() <= flat * std::pow(0.5 * fit.dd.trace(), 2)) return {};
  const Matrix2 gradient = fit.ud * fit.dd.inverse();                    // (T27)
  const double left = fit.uu - (gradient * fit.ud.transpose()).trace();  // (T28)
  return {tensor(gradient), std::max(0.0, left) / static_cast<double>(fit.count)};
}

}  // namespace

std::vector<LocalDeformation> local_deformations(const Frame& before, const BedFrame& bed) {
  std::vector<LocalDeformation> found(static_cast<std::size_t>(bed.statics.free_count));
  if (before.grain_count() != bed.frame.grain_count() || found.empty()) return found;
  const double reach = deformation_reach * bed.statics.mean_diameter, period = period_of(bed.statics);
  const Cells cells = sort_into_cells(before.x, before.y, reach, period);
  const std::vector<Vector2> moved = displacements(before, bed);
  for (Index i = 0; i < bed.statics.free_count; ++i) {
    Fit fit;
    const auto add = [&](Index j) {
      Vector2 d(before.x[j] - before.x[i], before.y[j] - before.y[i]);
      d.x() += nearest_image(d.x(), period) * period;
      if (j != i && d.squaredNorm() <= reach * reach) fit.add(d, moved[j] - moved[i]);
    };
    for (Index ring = 0; ring <= 1; ++ring)
      visit_ring(cells, column_of(cells, before.x[i]), row_of(cells, before.y[i]), ring, add);
    found[i] = fitted(fit);
  }
  return found;
}

double shear_strain(const Tensor2& gradient) {
  return std::hypot(gradient.xx - gradient.yy, gradient.xy + gradient.yx);  // (T29)
}

double area_strain(const Tensor2& gradient) {
  return gradient.xx + gradient.yy + gradient.xx * gradient.yy - gradient.xy * gradient.yx;
}

double vorticity(const Tensor2& gradient) {
  return 2.0 * std::atan2(gradient.yx - gradient.xy, 2.0 + gradient.xx + gradient.yy);
}

void measure_deformation(const Frame& before, const BedFrame& bed, FrameRecord& record) {
  std::vector<double> shears;
  double nonaffine = 0.0, largest = 0.0;
  for (const LocalDeformation& deformation : local_deformations(before, bed)) {
    if (std::isnan(deformation.nonaffine)) continue;
    shears.push_back(shear_strain(deformation.gradient));
    nonaffine += deformation.nonaffine;
    largest = std::max(largest, deformation.nonaffine);
  }
  if (shears.empty()) return;
  const auto count = static_cast<double>(shears.size());
  std::ranges::sort(shears, std::greater());
  const double sum = std::accumulate(shears.begin(), shears.end(), 0.0);
  const auto top = static_cast<std::ptrdiff_t>(std::ceil(most_strained_share * count));
  record.local_shear = sum / count;
  record.local_shear_share = std::accumulate(shears.begin(), shears.begin() + top, 0.0) / sum;
  record.nonaffine = std::sqrt(nonaffine / count);
  record.nonaffine_largest = std::sqrt(largest);
}

}  // namespace talus::analysis
