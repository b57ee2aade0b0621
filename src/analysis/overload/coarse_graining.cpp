#include "analysis/overload/coarse_graining.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/overload/neighbourhoods.h"
#include "core/statistics.h"
#include "stress/overload.h"
#include "stress/stress_state.h"

namespace talus::analysis {
namespace {

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
  result.length.assign(static_cast<std::size_t>(bed.statics.free_count), not_known);
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
  std::vector<double> result(static_cast<std::size_t>(bed.statics.free_count), not_known);
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
