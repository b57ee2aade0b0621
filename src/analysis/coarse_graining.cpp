#include "analysis/coarse_graining.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/neighbourhoods.h"
#include "stress/overload.h"
#include "stress/stress_state.h"

namespace talus {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Whether the ratio Q/P of stress_state is at most the threshold. Without its root and its arc tangent:
/// nothing else is computed as often.
bool is_within(const Tensor2& sum, double threshold) {
  const double difference = sum.xx - sum.yy;
  const double shear = sum.xy + sum.yx;
  const double mean = sum.xx + sum.yy;
  const double limit = threshold * mean;
  return mean > 0.0 && difference * difference + shear * shear <= limit * limit;
}

void summarise(CoarseGraining& result) {
  double sum = 0.0;
  double squares = 0.0;
  for (double length : result.length)
    if (!std::isnan(length)) {
      sum += length;
      result.largest = std::max(result.largest, length);
    }
  const auto count = static_cast<double>(result.overloaded);
  result.mean = result.overloaded > 0 ? sum / count : nan;
  if (result.overloaded == 0) result.largest = nan;
  for (double length : result.length)
    if (!std::isnan(length)) squares += (length - result.mean) * (length - result.mean);
  result.standard_error = result.overloaded > 1 ? std::sqrt(squares / (count - 1.0) / count) : nan;
}

}  // namespace

CoarseGraining coarse_graining(const Frame& frame, const RunStatics& statics,
                               const CoarseGrainingRule& rule) {
  CoarseGraining result;
  result.length.assign(static_cast<std::size_t>(statics.free_count), nan);
  Neighbourhoods neighbourhoods(frame, statics);
  for (Index i = 0; i < statics.free_count; ++i) {
    if (!is_overloaded(frame.gamma[i], rule.threshold)) continue;
    double length = rule.cut;
    bool found = false;
    neighbourhoods.around(i, 0.5 * rule.cut, [&](double distance, const Tensor2& sum) {
      found = is_within(sum, rule.end_ratio);
      if (found) length = 2.0 * distance;
      return !found;
    });
    result.length[i] = length;
    ++result.overloaded;
    if (!found) ++result.cut_off;
  }
  summarise(result);
  return result;
}

std::vector<double> coarse_stress_ratio(const Frame& frame, const RunStatics& statics, double l) {
  std::vector<double> result(static_cast<std::size_t>(statics.free_count), nan);
  Neighbourhoods neighbourhoods(frame, statics);
  for (Index i = 0; i < statics.free_count; ++i) {
    Tensor2 all;
    neighbourhoods.around(i, 0.5 * l, [&](double, const Tensor2& sum) {
      all = sum;
      return true;
    });
    result[i] = stress_state(all).ratio;
  }
  return result;
}

NeighbourhoodCurve neighbourhood_curve(const Frame& frame, const RunStatics& statics, Index grain,
                                       double largest) {
  NeighbourhoodCurve curve;
  Neighbourhoods(frame, statics).around(grain, 0.5 * largest, [&](double distance, const Tensor2& sum) {
    curve.l.push_back(2.0 * distance);
    curve.gamma.push_back(stress_state(sum).ratio);
    return true;
  });
  return curve;
}

}  // namespace talus
