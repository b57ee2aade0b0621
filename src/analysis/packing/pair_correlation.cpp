#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "analysis/free_grains.h"
#include "analysis/packing/packing.h"
#include "core/trigonometry.h"

namespace talus::analysis {
namespace {

constexpr double layer_over_d = 2.0;

/// Points with a value, which is replaced by its deviation from the mean.
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

/// Divides each value by the mean of its layer. Layers are `thickness` m thick, the first begins at the
/// lowest y. NaN if the mean is not positive.
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

/// Points sorted into rows of equal height and by x within a row, so that the neighbours of a point form one
/// block in each row. A periodic bed is extended on either side by copies of points, as far as the reach of
/// pairs.
struct SortedRows {
  struct Row {
    std::size_t first = 0, last = 0;          ///< range of its points and their copies
    std::size_t own_first = 0, own_last = 0;  ///< range of its points
  };
  double height = 1.0;  ///< m
  std::vector<Row> rows;
  std::vector<double> x, y, deviation;
};

/// Sorts points into rows with a height of an eighth of the reach. Lower rows would give more blocks, higher
/// ones more pairs beyond the reach.
SortedRows sort_into_rows(const Points& points, double reach, double period) {
  SortedRows sorted;
  if (points.x.empty()) return sorted;
  const auto [lowest, highest] = std::ranges::minmax(points.y);
  // Limits the memory if a point is far away from all others.
  const double most = static_cast<double>(points.x.size());
  sorted.height = std::max(reach / 8.0, (highest - lowest) / most);
  struct Entry {
    std::size_t row;
    double x;
    std::size_t point;
  };
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    const auto row = static_cast<std::size_t>((points.y[i] - lowest) / sorted.height);
    const double x = period > 0.0 ? points.x[i] - std::floor(points.x[i] / period) * period : points.x[i];
    entries.push_back({row, x, i});
    if (period > 0.0 && x < reach) entries.push_back({row, x + period, i});
    if (period > 0.0 && x >= period - reach) entries.push_back({row, x - period, i});
  }
  std::ranges::sort(entries, [](const Entry& a, const Entry& b) {
    return std::tie(a.row, a.x, a.point) < std::tie(b.row, b.x, b.point);
  });
  sorted.rows.resize(entries.back().row + 1);
  for (const Entry& entry : entries) {
    SortedRows::Row& row = sorted.rows[entry.row];
    if (row.last == 0) row = {sorted.x.size(), 0, sorted.x.size(), sorted.x.size()};
    row.last = sorted.x.size() + 1;
    if (period > 0.0 && entry.x < 0.0) row.own_first = row.last;
    if (!(period > 0.0) || entry.x < period) row.own_last = row.last;
    sorted.x.push_back(entry.x);
    sorted.y.push_back(points.y[entry.point]);
    sorted.deviation.push_back(points.deviation[entry.point]);
  }
  return sorted;
}

/// Sums over pairs in bins of their distance. Single precision determines the bin of nearly all pairs, four
/// at a time; double precision is used only if the distance is closer to the edge of a bin than the rounding
/// error.
class PairSums {
 public:
  struct Sum {
    double products = 0.0, pairs = 0.0;
  };

  PairSums(const SortedRows& rows, double reach, double width, int bins)
      : rows_(rows), reach_(reach), width_(width), bins_(bins), sums_(static_cast<std::size_t>(bins) + 1) {
    x_.assign(rows.x.begin(), rows.x.end());
    y_.assign(rows.y.begin(), rows.y.end());
    for (std::vector<float>* places : {&x_, &y_}) places->resize(places->size() + lanes);
    double farthest = 0.0;
    for (std::size_t i = 0; i < rows.x.size(); ++i)
      farthest = std::max(farthest, std::fabs(rows.x[i]) + std::fabs(rows.y[i]));
    // If the reach ends within a bin, all pairs are evaluated in double precision.
    if (reach > bins * width * (1.0 - 1e-9))
      error_ = static_cast<float>(4.0 * std::numeric_limits<float>::epsilon() * (farthest / width + bins));
  }

  /// Adds the pairs of a point with a block of points.
  void add_block(std::size_t i, std::size_t first, std::size_t last) {
    std::array<std::int32_t, piece>& bin = bin_;
    const float x = x_[i], y = y_[i], in_bins = static_cast<float>(1.0 / width_), error = error_;
    const float beyond = static_cast<float>(bins_) + 0.5F;
    const double deviation = rows_.deviation[i];
    for (; first < last; first += piece) {
      const std::size_t count = std::min(piece, last - first);
      const float* const other_x = x_.data() + first;
      const float* const other_y = y_.data() + first;
      for (std::size_t k = 0; k < (count + lanes - 1) / lanes * lanes; ++k) {
        const float dx = other_x[k] - x, dy = other_y[k] - y;
        const float place = std::min(std::sqrt(dx * dx + dy * dy) * in_bins, beyond);
        const auto whole = static_cast<std::int32_t>(place);
        const float part = place - static_cast<float>(whole);
        bin[k] = part < error || part > 1.0F - error ? not_sure : whole;
      }
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t at = bin[k] >= 0 ? static_cast<std::size_t>(bin[k]) : exact_bin(i, first + k);
        sums_[at].products += deviation * rows_.deviation[first + k];
        sums_[at].pairs += 1.0;
      }
    }
  }

  const Sum& sum(std::size_t bin) const { return sums_[bin]; }

 private:
  static constexpr std::size_t lanes = 4, piece = 64;
  static constexpr std::int32_t not_sure = -1;

  std::size_t exact_bin(std::size_t i, std::size_t j) const {
    const double dx = rows_.x[j] - rows_.x[i], dy = rows_.y[j] - rows_.y[i], square = dx * dx + dy * dy;
    if (square >= reach_ * reach_) return sums_.size() - 1;
    return static_cast<std::size_t>(std::min(std::sqrt(square) / width_, bins_ - 1.0));
  }

  const SortedRows& rows_;
  double reach_, width_;  ///< m
  int bins_;
  float error_ = 1.0F;                     ///< largest error of a distance in single precision, in bins
  std::vector<float> x_, y_;               ///< coordinates in the rows, with padding at the end
  std::array<std::int32_t, piece> bin_{};  ///< bins of the pairs of a piece; working memory
  std::vector<Sum> sums_;                  ///< sums of the bins, and of all pairs beyond the reach
};

/// Adds the pairs of the points of a row with those of the same row or a row above it.
void add_pairs(const SortedRows& rows, std::size_t row, std::size_t above, double reach, PairSums& sums) {
  const SortedRows::Row& from = rows.rows[row];
  const SortedRows::Row& to = rows.rows[above];
  const double apart = above > row + 1 ? static_cast<double>(above - row - 1) * rows.height : 0.0;
  if (apart >= reach) return;
  const double across = std::sqrt(reach * reach - apart * apart) * (1.0 + 1e-12);  // allows for rounding
  std::size_t first = to.first, last = to.first;
  for (std::size_t i = from.own_first; i < from.own_last; ++i) {
    while (first < to.last && rows.x[first] < rows.x[i] - across) ++first;
    while (last < to.last && rows.x[last] <= rows.x[i] + across) ++last;
    sums.add_block(i, above == row ? i + 1 : first, last);
  }
}

}  // namespace

PairCorrelation pair_correlation(const std::vector<double>& x, const std::vector<double>& y,
                                 const std::vector<double>& value, double largest, int bins, double period) {
  const Points points = points_with_value(x, y, value);
  const double reach = period > 0.0 ? std::min(largest, 0.5 * period) : largest;
  const SortedRows rows = sort_into_rows(points, reach, period);
  PairSums sums(rows, reach, largest / bins, bins);
  const auto steps = static_cast<std::size_t>(std::ceil(reach / rows.height)) + 1;
  for (std::size_t row = 0; row < rows.rows.size(); ++row)
    for (std::size_t other = row; other < std::min(row + steps, rows.rows.size()); ++other)
      add_pairs(rows, row, other, reach, sums);
  PairCorrelation result;
  for (std::size_t bin = 0; bin < static_cast<std::size_t>(bins); ++bin) {
    const auto [products, pairs] = sums.sum(bin);
    const bool any = pairs > 0.0 && points.variance > 0.0;
    result.r.push_back((static_cast<double>(bin) + 0.5) * largest / bins);
    result.value.push_back(any ? products / (pairs * points.variance) : not_known);
    result.pairs.push_back(pairs);
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
  return pair_correlation(
      free_grain_values(bed.frame.x, bed.statics), free_grain_values(bed.frame.y, bed.statics),
      free_grain_values(bed.frame.gamma, bed.statics), largest, bins, period_of(bed.statics));
}

PairCorrelation mean_stress_correlation(const BedFrame& bed, double largest, int bins) {
  std::vector<double> mean_stress;
  for (Index i = 0; i < bed.statics.free_count; ++i) {
    const Tensor2& moment = bed.frame.internal_moment[i];
    mean_stress.push_back((moment.xx + moment.yy) / (pi * bed.statics.radius[i] * bed.statics.radius[i]));
  }
  const std::vector<double> y = free_grain_values(bed.frame.y, bed.statics);
  return pair_correlation(free_grain_values(bed.frame.x, bed.statics), y,
                          over_layer_mean(y, mean_stress, layer_over_d * bed.statics.mean_diameter), largest,
                          bins, period_of(bed.statics));
}

}  // namespace talus::analysis
