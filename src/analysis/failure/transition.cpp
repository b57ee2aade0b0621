#include "analysis/failure/transition.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace talus::analysis {
namespace {

constexpr std::size_t lasting = 3;  // frames in which a cluster has to span the bed
constexpr std::size_t min_to_fit = 5;

/// Returns the number of tilts up to theta_c, or of all tilts if it is NaN.
std::size_t count_up_to(std::span<const double> tilts, double theta_c) {
  if (std::isnan(theta_c)) return tilts.size();
  return static_cast<std::size_t>(std::ranges::upper_bound(tilts, theta_c) - tilts.begin());
}

/// Returns means over an equal number of neighbours on either side, within `reach` and within the series.
std::vector<double> symmetric_means(std::span<const double> tilts, std::span<const double> strains,
                                    double reach) {
  std::vector<double> means;
  for (std::size_t i = 0; i < tilts.size(); ++i) {
    double sum = strains[i];
    std::size_t n = 1;
    for (; n <= i && i + n < tilts.size() && tilts[i + n] - tilts[i] <= reach &&
           tilts[i] - tilts[i - n] <= reach;
         ++n)
      sum += strains[i - n] + strains[i + n];
    means.push_back(sum / static_cast<double>(2 * n - 1));
  }
  return means;
}

}  // namespace

LengthJump length_jump(std::span<const double> tilts, std::span<const double> lengths, double theta_c,
                       double cut) {
  LengthJump jump{not_known, not_known, not_known};
  double largest = 0.0;
  for (std::size_t k = 1; k < count_up_to(tilts, theta_c) && !(lengths[k - 1] >= cut); ++k) {
    const double increase = lengths[k] - lengths[k - 1];
    if (!(increase > largest)) continue;
    largest = increase;
    jump = {tilts[k], tilts[k] - tilts[k - 1], increase};
  }
  return jump;
}

PercolationOnset percolation_onset(std::span<const double> tilts, std::span<const Index> spans,
                                   double theta_c) {
  const std::size_t count = count_up_to(tilts, theta_c);
  for (std::size_t k = 0; k < count && k + lasting <= spans.size(); ++k)
    if (std::ranges::count(spans.subspan(k, lasting), 0) == 0)
      return {tilts[k], k > 0 ? tilts[k] - tilts[k - 1] : not_known};
  return {not_known, not_known};
}

DilationOnset dilation_onset(std::span<const double> tilts, std::span<const double> strains, double theta_c,
                             double window) {
  const std::size_t count = count_up_to(tilts, theta_c);
  if (count == 0) return {not_known, not_known, not_known};
  const auto means = symmetric_means(tilts.first(count), strains.first(count), 0.5 * window);
  double squares = 0.0;
  for (std::size_t i = 0; i < count; ++i) squares += (strains[i] - means[i]) * (strains[i] - means[i]);
  const auto lowest = std::ranges::min_element(means);
  const double limit = *lowest + std::sqrt(squares / static_cast<double>(count));
  auto low = lowest, high = lowest;
  while (low != means.begin() && *std::prev(low) <= limit) --low;
  while (std::next(high) != means.end() && *std::next(high) <= limit) ++high;
  if (std::next(high) == means.end()) return {not_known, not_known, not_known};
  const auto tilt_of = [&](auto place) { return tilts[static_cast<std::size_t>(place - means.begin())]; };
  return {tilt_of(lowest), tilt_of(low), tilt_of(high)};
}

GrowthExponent growth_exponent(std::span<const double> tilts, std::span<const double> sizes, double theta_c,
                               double window) {
  std::vector<double> x, y;
  for (std::size_t k = 0; k < tilts.size(); ++k)
    if (const double left = theta_c - tilts[k]; left > 0.0 && left <= window && sizes[k] > 0.0) {
      x.push_back(std::log(left));
      y.push_back(std::log(sizes[k]));
    }
  if (x.size() < min_to_fit) return {not_known, not_known};
  const auto n = static_cast<double>(x.size());
  const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / n;
  const double mean_y = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xx = 0.0, xy = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - mean_x) * (x[k] - mean_x);
    xy += (x[k] - mean_x) * (y[k] - mean_y);
  }
  const double slope = xy / xx;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double residual = y[k] - mean_y - slope * (x[k] - mean_x);
    squares += residual * residual;
  }
  return {-slope, std::sqrt(squares / (n - 2.0) / xx)};
}

double first_slide(std::span<const double> tilts, std::span<const double> displacements, double distance,
                   double window) {
  std::size_t end = 0;  // last row within the window of row k
  for (std::size_t k = 0; k < tilts.size(); ++k) {
    while (end + 1 < tilts.size() && tilts[end + 1] - tilts[k] <= window) ++end;
    if (displacements[end] - displacements[k] >= distance) return tilts[k];
  }
  return not_known;
}

}  // namespace talus::analysis
