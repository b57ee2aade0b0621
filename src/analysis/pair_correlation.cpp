#include "analysis/pair_correlation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "analysis/cells.h"
#include "analysis/free_grains.h"
#include "core/trigonometry.h"

namespace talus {
namespace {

constexpr double layer_over_d = 2.0;

/// The points that have a value, which becomes the deviation from the mean.
struct Points {
  std::vector<double> x, y, deviation;
  double variance = 0.0;
};

Points points_with_value(const std::vector<double>& x, const std::vector<double>& y,
                         const std::vector<double>& value) {
  Points points;
  double sum = 0.0;
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (std::isnan(value[i])) continue;
    points.x.push_back(x[i]);
    points.y.push_back(y[i]);
    points.deviation.push_back(value[i]);
    sum += value[i];
  }
  const auto count = static_cast<double>(points.x.size());
  for (double& each : points.deviation) {
    each -= sum / count;
    points.variance += each * each / count;
  }
  return points;
}

/// Each value over the mean of those in its layer; layers are `thickness` m thick, the first from the lowest
/// y. NaN where that mean is not positive.
std::vector<double> over_layer_mean(const std::vector<double>& y, const std::vector<double>& value,
                                    double thickness) {
  if (y.empty()) return {};
  const double lowest = *std::min_element(y.begin(), y.end());
  std::map<Index, std::pair<double, Index>> layers;  // sum and number
  const auto layer_of = [&](double height) { return static_cast<Index>((height - lowest) / thickness); };
  for (std::size_t i = 0; i < y.size(); ++i) {
    auto& [sum, count] = layers[layer_of(y[i])];
    sum += value[i];
    ++count;
  }
  std::vector<double> result;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const auto& [sum, count] = layers[layer_of(y[i])];
    result.push_back(sum > 0.0 ? value[i] * count / sum : not_known);
  }
  return result;
}

}  // namespace

PairCorrelation pair_correlation(const std::vector<double>& x, const std::vector<double>& y,
                                 const std::vector<double>& value, double largest, int bins, double period) {
  const Points points = points_with_value(x, y, value);
  const Cells cells = sort_into_cells(points.x, points.y, 0.5 * largest, period);
  const auto count = static_cast<std::size_t>(bins);
  const double width = largest / bins;
  std::vector<double> sums(count, 0.0), pairs(count, 0.0);
  for (Index i = 0; i < static_cast<Index>(points.x.size()); ++i) {
    const auto add = [&](Index j) {
      if (j <= i) return;
      double dx = points.x[j] - points.x[i];
      dx += nearest_image(dx, period) * period;
      const double dy = points.y[j] - points.y[i];
      const double square = dx * dx + dy * dy;
      if (square >= largest * largest) return;
      const std::size_t bin = std::min(static_cast<std::size_t>(std::sqrt(square) / width), count - 1);
      sums[bin] += points.deviation[i] * points.deviation[j];
      pairs[bin] += 1.0;
    };
    const Index column = column_of(cells, points.x[i]);
    const Index row = row_of(cells, points.y[i]);
    for (Index ring = 0; ring <= 2; ++ring) visit_ring(cells, column, row, ring, add);
  }
  PairCorrelation result;
  for (std::size_t bin = 0; bin < count; ++bin) {
    const bool any = pairs[bin] > 0.0 && points.variance > 0.0;
    result.r.push_back((static_cast<double>(bin) + 0.5) * width);
    result.value.push_back(any ? sums[bin] / (pairs[bin] * points.variance) : not_known);
    result.pairs.push_back(pairs[bin]);
  }
  return result;
}

PairCorrelation force_correlation(const BedFrame& bed, double largest, int bins) {
  const FrameContacts& contacts = bed.frame.contacts;
  return pair_correlation(contacts.px, contacts.py,
                          over_layer_mean(contacts.py, contacts.fn, layer_over_d * bed.statics.mean_diameter),
                          largest, bins, period_of(bed.statics));
}

PairCorrelation stress_ratio_correlation(const BedFrame& bed, double largest, int bins) {
  return pair_correlation(of_free_grains(bed.frame.x, bed.statics), of_free_grains(bed.frame.y, bed.statics),
                          of_free_grains(bed.frame.gamma, bed.statics), largest, bins,
                          period_of(bed.statics));
}

PairCorrelation mean_stress_correlation(const BedFrame& bed, double largest, int bins) {
  std::vector<double> mean_stress;
  for (Index i = 0; i < bed.statics.free_count; ++i) {
    const Tensor2& moment = bed.frame.internal_moment[i];
    mean_stress.push_back((moment.xx + moment.yy) / (pi * bed.statics.radius[i] * bed.statics.radius[i]));
  }
  const std::vector<double> y = of_free_grains(bed.frame.y, bed.statics);
  return pair_correlation(of_free_grains(bed.frame.x, bed.statics), y,
                          over_layer_mean(y, mean_stress, layer_over_d * bed.statics.mean_diameter), largest,
                          bins, period_of(bed.statics));
}

}  // namespace talus
