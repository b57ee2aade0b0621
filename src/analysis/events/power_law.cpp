#include "analysis/events/power_law.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace talus::analysis {
namespace {

/// Returns the finite values from `minimum` upwards, ascending.
std::vector<double> ascending_from(std::span<const double> values, double minimum) {
  std::vector<double> tail;
  for (const double value : values)
    if (value >= minimum && std::isfinite(value)) tail.push_back(value);
  std::ranges::sort(tail);
  return tail;
}

/// Fits the law to `tail`, which ascends from the minimum.
PowerLaw law_of_tail(std::span<const double> tail, double minimum) {
  PowerLaw law;
  law.minimum = minimum;
  law.count = static_cast<int>(tail.size());
  double logarithms = 0.0;
  for (const double value : tail) logarithms += std::log(value / minimum);
  if (law.count < min_fitted_values || !(logarithms > 0.0)) return law;
  const auto n = static_cast<double>(tail.size());
  law.exponent = 1.0 + n / logarithms;
  law.error = (law.exponent - 1.0) / std::sqrt(n);
  law.distance = 0.0;
  for (std::size_t k = 0; k < tail.size(); ++k) {
    const double below = 1.0 - law.share_from(tail[k]);
    const double before = static_cast<double>(k) / n, after = static_cast<double>(k + 1) / n;
    law.distance = std::max({law.distance, std::fabs(below - before), std::fabs(below - after)});
  }
  return law;
}

}  // namespace

double PowerLaw::share_from(double x) const { return std::pow(x / minimum, 1.0 - exponent); }

PowerLaw power_law_from(std::span<const double> values, double minimum) {
  return law_of_tail(ascending_from(values, minimum), minimum);
}

PowerLaw power_law(std::span<const double> values) {
  std::vector<double> all = ascending_from(values, 0.0);
  std::erase(all, 0.0);
  PowerLaw best;
  best.count = static_cast<int>(all.size());
  for (std::size_t k = 0; k + min_fitted_values <= all.size(); ++k) {
    if (k > 0 && all[k] == all[k - 1]) continue;
    const PowerLaw law = law_of_tail(std::span(all).subspan(k), all[k]);
    if (std::isfinite(law.exponent) && !(law.distance >= best.distance)) best = law;
  }
  return best;
}

ExponentialLaw exponential_law(std::span<const double> values, double minimum) {
  const std::vector<double> waits = ascending_from(values, minimum);
  ExponentialLaw law;
  law.count = static_cast<int>(waits.size());
  if (law.count < min_fitted_values) return law;
  const auto n = static_cast<double>(waits.size());
  double sum = 0.0;
  for (const double wait : waits) sum += wait - minimum;
  law.mean = sum / n;
  law.error = law.mean / std::sqrt(n);
  return law;
}

}  // namespace talus::analysis
