#include "analysis/packing/packing.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/cells.h"
#include "analysis/free_grains.h"
#include "core/tensor.h"
#include "core/trigonometry.h"
#include "stress/free_surface.h"
#include "stress/stress.h"

namespace talus::analysis {

namespace {

Tensor2 over(const Tensor2& moment, double volume) {
  return tensor(matrix(moment) / volume);  // (T20)
}

/// Returns the area of a disk below a height measured from its centre, m^2.
double area_below(double height, double radius) {
  const double u = std::clamp(height / radius, -1.0, 1.0);
  return radius * radius * (0.5 * pi + u * std::sqrt(1.0 - u * u) + std::asin(u));
}

}  // namespace

double frame_volume(const BedFrame& bed) {
  Grains grains;
  grains.free_count = bed.statics.free_count;
  grains.x = bed.frame.x;
  grains.y = bed.frame.y;
  grains.radius = bed.statics.radius;
  Boundary boundary;
  boundary.periodic = bed.statics.periodic;
  boundary.length = bed.statics.length;
  return stress::bed_volume(grains, boundary);
}

double bulk_solid_fraction(const BedFrame& bed, double volume) {
  const double low = bulk_margin * bed.statics.mean_diameter;
  const double high = volume / bed.statics.length - low;
  if (!(high > low)) return not_known;
  double area = 0.0;
  for (Index i = 0; i < bed.statics.free_count; ++i)
    area += area_below(high - bed.frame.y[i], bed.statics.radius[i]) -
            area_below(low - bed.frame.y[i], bed.statics.radius[i]);
  return area / (bed.statics.length * (high - low));
}

void measure_packing_stress(const BedFrame& bed, double volume, FrameRecord& record) {
  const Tensor2 sigma =
      over(stress::sum_of_moments(bed.frame.internal_moment, 0, bed.statics.free_count), volume);
  record.stress = {sigma.xx, sigma.xy, sigma.yx, sigma.yy};
  record.sigma_t_over_n = -sigma.yx / sigma.yy;
  record.stress_ratio = stress::stress_state(sigma).ratio;
}

std::vector<Tensor2> section_stresses(const BedFrame& bed, double volume, int count) {
  std::vector<Tensor2> sections(count);
  for (Index i = 0; i < bed.statics.free_count; ++i) {
    // Rounding may place a centre exactly at the end of the bed.
    const auto section = static_cast<int>(std::floor(bed.frame.x[i] / bed.statics.length * count));
    add_to(sections[std::clamp(section, 0, count - 1)], bed.frame.internal_moment[i]);
  }
  for (Tensor2& section : sections) section = over(section, volume / count);
  return sections;
}

Histogram stress_ratio_distribution(const BedFrame& bed, int bins) {
  Histogram histogram(0.0, 1.0, bins);
  for (double gamma : free_grain_values(bed.frame.gamma, bed.statics)) histogram.add(gamma);
  return histogram;
}

namespace {

using Polygon = std::vector<Vector2>;

/// Removes the part of the polygon beyond `height` along the unit vector `normal`; `scratch` is working
/// memory.
void clip(Polygon& polygon, const Vector2& normal, double height, Polygon& scratch) {
  const auto beyond = [&](const Vector2& point) { return normal.dot(point) - height; };
  if (std::ranges::none_of(polygon, [&](const Vector2& point) { return beyond(point) > 0.0; })) return;
  scratch.clear();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector2 &from = polygon[k], &to = polygon[(k + 1) % polygon.size()];
    const double a = beyond(from), b = beyond(to);
    if (a <= 0.0) scratch.push_back(from);
    if ((a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0)) scratch.push_back(from + (to - from) * (a / (a - b)));
  }
  std::swap(polygon, scratch);
}

/// Cuts the cells of grains, in coordinates about the centre of each grain.
class CellCutter {
 public:
  explicit CellCutter(const BedFrame& bed)
      : bed_(bed),
        period_(period_of(bed.statics)),
        reach_(reaches(bed.statics)),
        cells_(sort_into_cells(bed.frame.x, bed.frame.y, 2.0 * std::ranges::max(reach_), period_)) {}

  GrainCell cell(Index i) {
    const double half = reach_[i];
    polygon_ = {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
    for (Index ring = 0; ring <= 1; ++ring)
      visit_ring(cells_, column_of(cells_, bed_.frame.x[i]), row_of(cells_, bed_.frame.y[i]), ring,
                 [&](Index j) { cut_by_grain(i, j); });
    cut_by_planes(i);
    GrainCell cell;
    const double limit = half * half * (1.0 + 1e-12);
    cell.is_open =
        std::ranges::any_of(polygon_, [&](const Vector2& corner) { return corner.squaredNorm() > limit; });
    cell.corners.reserve(polygon_.size());
    for (const Vector2& corner : polygon_)
      cell.corners.push_back({bed_.frame.x[i] + corner.x(), bed_.frame.y[i] + corner.y()});
    return cell;
  }

 private:
  double radius(Index i) const { return bed_.statics.radius[i]; }
  /// Returns the radius of the circle of largest power around each grain. Two grains whose circles do not
  /// meet do not cut each other's cells within these circles.
  static std::vector<double> reaches(const RunStatics& statics) {
    const double farthest = largest_power * statics.mean_diameter * statics.mean_diameter;
    std::vector<double> reaches;
    for (const double radius : statics.radius) reaches.push_back(std::sqrt(radius * radius + farthest));
    return reaches;
  }

  void cut_by_grain(Index i, Index j) {
    if (i == j) return;
    Vector2 d(bed_.frame.x[j] - bed_.frame.x[i], bed_.frame.y[j] - bed_.frame.y[i]);
    d.x() += nearest_image(d.x(), period_) * period_;
    const double together = reach_[i] + reach_[j], square = d.squaredNorm();
    if (square > together * together * (1.0 + 1e-12)) return;  // avoids the square root in most cases
    const double distance = std::sqrt(square);
    if (!(distance > 0.0) || distance >= together) return;
    const double height =
        (distance * distance + radius(i) * radius(i) - radius(j) * radius(j)) / (2.0 * distance);  // (T30)
    clip(polygon_, d / distance, height, scratch_);
  }

  void cut_by_planes(Index i) {
    if (period_ == 0.0) {
      clip(polygon_, {-1.0, 0.0}, bed_.frame.x[i], scratch_);
      clip(polygon_, {1.0, 0.0}, bed_.statics.length - bed_.frame.x[i], scratch_);
    }
    const bool smooth_floor = bed_.statics.free_count == bed_.frame.grain_count();
    if (smooth_floor) clip(polygon_, {0.0, -1.0}, bed_.frame.y[i], scratch_);
  }

  BedFrame bed_;
  double period_;
  std::vector<double> reach_;  ///< radius of the circle of largest power of each grain, m
  Cells cells_;
  Polygon polygon_, scratch_;
};

}  // namespace

double GrainCell::area() const {
  double twice = 0.0;
  // Relative to the first corner, to avoid cancellation.
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    const Vec2 &o = corners[0], &a = corners[k], &b = corners[k + 1];
    twice += (a.x - o.x) * (b.y - o.y) - (b.x - o.x) * (a.y - o.y);
  }
  return 0.5 * twice;
}

std::vector<GrainCell> grain_cells(const BedFrame& bed) {
  std::vector<GrainCell> cells;
  if (bed.statics.free_count == 0) return cells;
  CellCutter cutter(bed);
  cells.reserve(bed.statics.free_count);
  for (Index i = 0; i < bed.statics.free_count; ++i) cells.push_back(cutter.cell(i));
  return cells;
}

std::vector<double> local_solid_fractions(const BedFrame& bed) {
  const std::vector<GrainCell> cells = grain_cells(bed);
  std::vector<double> fractions;
  for (std::size_t i = 0; i < cells.size(); ++i)
    fractions.push_back(
        cells[i].is_open ? not_known : pi * bed.statics.radius[i] * bed.statics.radius[i] / cells[i].area());
  return fractions;
}

void measure_local_solid_fraction(const BedFrame& bed, FrameRecord& record) {
  double sum = 0.0, squares = 0.0, count = 0.0;
  const std::vector<double> fractions = local_solid_fractions(bed);
  for (const double fraction : fractions)
    if (!std::isnan(fraction)) {
      sum += fraction;
      count += 1.0;
    }
  record.local_solid_fraction = sum / count;
  for (const double fraction : fractions)
    if (!std::isnan(fraction)) squares += std::pow(fraction - record.local_solid_fraction, 2);
  record.local_solid_fraction_spread = std::sqrt(squares / count);
}

}  // namespace talus::analysis
