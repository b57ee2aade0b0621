#include "analysis/overload/coarse_graining.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "analysis/cells.h"
#include "analysis/free_grains.h"
#include "core/statistics.h"
#include "stress/stress.h"

namespace talus::analysis {
namespace {

/// A grain and its distance.
struct Neighbour {
  double square = 0.0;  ///< squared distance, m^2
  Index grain = 0;
  bool operator<(const Neighbour& other) const {
    return square < other.square || (square == other.square && grain < other.grain);
  }
};

/// Moves the entries with a squared distance up to `high` (m^2) to the front, sorted, and returns their
/// number. No entry may be below `low` (m^2). Fast if the grains are evenly spread over an area. `scratch` is
/// working memory.
std::size_t sort_nearest(std::vector<Neighbour>& neighbours, double low, double high,
                         std::vector<Neighbour>& scratch) {
  // The squared distances of grains that are evenly spread over an area are uniformly distributed, so this
  // number of buckets gives about one grain each.
  constexpr Index max_buckets = 256;
  const Index buckets = std::clamp<Index>(static_cast<Index>(neighbours.size()), 1, max_buckets);
  const double scale = std::isfinite(high) && high > low ? buckets / (high - low) : 0.0;
  const auto bucket_of = [&](const Neighbour& one) {
    if (one.square > high) return buckets;
    return std::min(buckets - 1, static_cast<Index>((one.square - low) * scale));
  };
  std::array<Index, max_buckets + 2> start;
  std::fill_n(start.begin(), buckets + 2, 0);
  for (const Neighbour& one : neighbours) ++start[bucket_of(one) + 1];
  for (Index k = 1; k <= buckets; ++k) start[k] += start[k - 1];
  const std::size_t count = start[buckets];
  scratch.resize(neighbours.size());
  for (const Neighbour& one : neighbours) scratch[start[bucket_of(one)]++] = one;
  neighbours.swap(scratch);
  // Only the order within a bucket may still be wrong.
  for (std::size_t k = 1; k < count; ++k) {
    const Neighbour one = neighbours[k];
    std::size_t place = k;
    for (; place > 0 && one < neighbours[place - 1]; --place) neighbours[place] = neighbours[place - 1];
    neighbours[place] = one;
  }
  return count;
}

/// The free grains of a frame, visited in the order of their distance from one of them. Only the nearest
/// periodic image counts.
class Neighbourhoods {
 public:
  explicit Neighbourhoods(const BedFrame& bed)
      : moments_(bed.frame.internal_moment),
        x_(free_grain_values(bed.frame.x, bed.statics)),
        y_(free_grain_values(bed.frame.y, bed.statics)),
        cells_(sort_into_cells(x_, y_, bed.statics.mean_diameter, period_of(bed.statics))) {}

  /// Adds up the internal moments of the grains within `radius` (m) of a grain, itself included, in the order
  /// of their distance, and of their ids at equal distance. Calls visit(distance, sum) after each distance
  /// until it returns false.
  template <typename Visit>
  void around(Index centre, double radius, const Visit& visit) {
    const Index column = column_of(cells_, x_[centre]);
    const Index row = row_of(cells_, y_[centre]);
    neighbours_.clear();
    Tensor2 sum;
    double reached = 0.0;  // all grains up to this distance are in the sum
    // Slightly larger than the square because of rounding; the distance itself is compared below.
    const double farthest = radius * radius * (1.0 + 1e-9);
    for (Index ring = 0; reached <= radius; ++ring) {
      const bool more =
          visit_ring(cells_, column, row, ring, [&](Index grain) { add(centre, grain, farthest); });
      // Grains in none of the rings so far are farther than `known`, which is slightly less than the width of
      // the rings because distances are rounded.
      const double known = more ? ring * cells_.size * (1.0 - 1e-9) : std::numeric_limits<double>::infinity();
      const std::size_t count = sort_nearest(neighbours_, reached * reached, known * known, scratch_);
      for (std::size_t k = 0; k < count; ++k) {
        const double distance = std::sqrt(neighbours_[k].square);
        if (distance > radius) return;
        add_to(sum, moments_[neighbours_[k].grain]);  // (T24)
        const bool last_of_distance = k + 1 == count || neighbours_[k + 1].square > neighbours_[k].square;
        if (last_of_distance && !visit(distance, sum)) return;
      }
      neighbours_.erase(neighbours_.begin(), neighbours_.begin() + static_cast<std::ptrdiff_t>(count));
      reached = known;
    }
  }

 private:
  /// Adds a grain if its squared distance is at most `farthest`.
  void add(Index centre, Index grain, double farthest) {
    double dx = x_[grain] - x_[centre];
    dx += nearest_image(dx, cells_.period) * cells_.period;
    const double dy = y_[grain] - y_[centre];
    const double square = dx * dx + dy * dy;
    if (square <= farthest) neighbours_.push_back({square, grain});
  }

  const std::vector<Tensor2>& moments_;
  std::vector<double> x_, y_;
  Cells cells_;
  std::vector<Neighbour> neighbours_, scratch_;
};

/// Whether the ratio Q/P of stress_state is at most the threshold. The test avoids the square root and the
/// arc tangent because it is the most frequent operation of the analysis.
bool is_within(const Tensor2& sum, double threshold) {
  const double difference = sum.xx - sum.yy;
  const double shear = sum.xy + sum.yx;
  const double mean = sum.xx + sum.yy;
  const double limit = threshold * mean;
  return mean > 0.0 && difference * difference + shear * shear <= limit * limit;
}

void summarise(CoarseGraining& result) {
  const Statistics lengths = statistics_of(result.length);
  result.mean = lengths.mean;
  result.standard_error = lengths.error;
  result.largest = not_known;
  for (const double length : result.length) result.largest = std::fmax(result.largest, length);
}

/// Returns l_c of an overloaded grain, m; empty if the search reaches the cut.
std::optional<double> search_length(Neighbourhoods& neighbourhoods, Index grain,
                                    const CoarseGrainingRule& rule) {
  std::optional<double> found;
  neighbourhoods.around(grain, 0.5 * rule.cut, [&](double distance, const Tensor2& sum) {
    const double l = 2.0 * distance;
    // gamma_l is constant up to the next distance, so the last neighbourhood up to l_min is the one at l_min.
    if (found && l > rule.l_min) return false;
    found.reset();
    if (is_within(sum, rule.end_ratio)) found = std::max(l, rule.l_min);  // (T25)
    return !found || l < rule.l_min;
  });
  return found;
}

}  // namespace

Frame with_gamma_of_neighbourhoods(Frame frame, const RunStatics& statics, double l_min) {
  if (l_min == 0.0) return frame;
  const std::vector<double> gamma = coarse_stress_ratio({frame, statics}, l_min);
  for (std::size_t i = 0; i < gamma.size(); ++i)
    if (!std::isnan(frame.gamma[i])) frame.gamma[i] = gamma[i];
  return frame;
}

double length_cut(const RunStatics& statics, double l_min, std::optional<double> cut) {
  const double diameter = statics.mean_diameter;
  const double asked = cut ? *cut * diameter : std::min(statics.depth, 0.5 * statics.length);
  return std::max(l_min * diameter, statics.periodic ? std::min(asked, statics.length) : asked);
}

CoarseGraining coarse_graining(const BedFrame& bed, const CoarseGrainingRule& rule) {
  CoarseGraining result;
  result.length.assign(bed.statics.free_count, not_known);
  Neighbourhoods neighbourhoods(bed);
  for (Index i = 0; i < bed.statics.free_count; ++i) {
    if (!stress::is_overloaded(bed.frame.gamma[i], rule.threshold)) continue;
    const std::optional<double> length = search_length(neighbourhoods, i, rule);
    result.length[i] = length.value_or(rule.cut);
    ++result.overloaded;
    if (!length) ++result.cut_off;
  }
  summarise(result);
  return result;
}

std::vector<double> coarse_stress_ratio(const BedFrame& bed, double l) {
  std::vector<double> result(bed.statics.free_count, not_known);
  Neighbourhoods neighbourhoods(bed);
  for (Index i = 0; i < bed.statics.free_count; ++i) {
    Tensor2 all;
    neighbourhoods.around(i, 0.5 * l, [&](double, const Tensor2& sum) {
      all = sum;
      return true;
    });
    result[i] = stress::stress_state(all).ratio;
  }
  return result;
}

std::vector<double> overloaded_over_scale(const BedFrame& bed, double threshold, std::span<const double> l) {
  std::vector<Index> overloaded(l.size(), 0);
  Index loaded = 0;
  Neighbourhoods neighbourhoods(bed);
  for (Index i = 0; i < bed.statics.free_count; ++i) {
    if (std::isnan(bed.frame.gamma[i])) continue;
    ++loaded;
    Tensor2 within;
    std::size_t next = 0;  // first diameter not yet evaluated
    const auto judge_up_to = [&](double diameter) {
      for (; next < l.size() && l[next] < diameter; ++next)
        if (stress::is_overloaded(stress::stress_state(within).ratio, threshold)) ++overloaded[next];
    };
    neighbourhoods.around(i, 0.5 * l.back(), [&](double distance, const Tensor2& sum) {
      judge_up_to(2.0 * distance);
      within = sum;
      return true;
    });
    judge_up_to(std::numeric_limits<double>::infinity());
  }
  std::vector<double> shares;
  for (const Index count : overloaded) shares.push_back(static_cast<double>(count) / loaded);
  return shares;
}

NeighbourhoodCurve neighbourhood_curve(const BedFrame& bed, Index grain, double largest) {
  NeighbourhoodCurve curve;
  Neighbourhoods(bed).around(grain, 0.5 * largest, [&](double distance, const Tensor2& sum) {
    curve.l.push_back(2.0 * distance);
    curve.gamma.push_back(stress::stress_state(sum).ratio);
    return true;
  });
  return curve;
}

}  // namespace talus::analysis
