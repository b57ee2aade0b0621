#include "core/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/types.h"

namespace talus {
namespace {

std::vector<double> numbers_among(std::span<const double> values) {
  std::vector<double> numbers;
  std::ranges::copy_if(values, std::back_inserter(numbers), [](double value) { return !std::isnan(value); });
  return numbers;
}

/// Returns a quantile of at least one value, in ascending order.
double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  if (below + 1 == sorted.size()) return sorted[below];
  return sorted[below] + (place - std::floor(place)) * (sorted[below + 1] - sorted[below]);
}

}  // namespace

double Statistics::interval() const { return count < 2 ? not_known : student_t(count - 1) * error; }

Statistics statistics_of(std::span<const double> values) {
  Statistics result{0, not_known, not_known, not_known};
  double sum = 0.0;
  for (const double value : values)
    if (!std::isnan(value)) {
      sum += value;
      ++result.count;
    }
  if (result.count == 0) return result;
  result.mean = sum / result.count;
  if (result.count == 1) return result;
  double squares = 0.0;
  for (const double value : values)
    if (!std::isnan(value)) squares += (value - result.mean) * (value - result.mean);
  result.deviation = std::sqrt(squares / (result.count - 1.0));
  result.error = std::sqrt(squares / (result.count - 1.0) / result.count);
  return result;
}

Summary summary_of(std::span<const double> values) {
  Summary summary{statistics_of(values), not_known, not_known, not_known, not_known, not_known};
  const double half = summary.statistics.interval();
  summary.low = summary.statistics.mean - half;
  summary.high = summary.statistics.mean + half;
  std::vector<double> numbers = numbers_among(values);
  if (numbers.empty()) return summary;
  std::ranges::sort(numbers);
  summary.lower_quartile = quantile(numbers, 0.25);
  summary.median = quantile(numbers, 0.5);
  summary.upper_quartile = quantile(numbers, 0.75);
  return summary;
}

Correlation correlation_of(std::span<const double> left, std::span<const double> right) {
  std::vector<double> a, b;
  for (std::size_t k = 0; k < left.size(); ++k)
    if (!std::isnan(left[k]) && !std::isnan(right[k])) {
      a.push_back(left[k]);
      b.push_back(right[k]);
    }
  Correlation found{not_known, static_cast<int>(a.size())};
  if (found.count < 3) return found;
  const Statistics statistics_a = statistics_of(a), statistics_b = statistics_of(b);
  double products = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k)
    products += (a[k] - statistics_a.mean) * (b[k] - statistics_b.mean);
  const double scale = statistics_a.deviation * statistics_b.deviation * (found.count - 1.0);
  if (scale > 0.0) found.coefficient = products / scale;
  return found;
}

double student_t(int freedom) {
  constexpr std::array<double, 30> table = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306,
                                            2.262,  2.228, 2.201, 2.179, 2.160, 2.145, 2.131, 2.120,
                                            2.110,  2.101, 2.093, 2.086, 2.080, 2.074, 2.069, 2.064,
                                            2.060,  2.056, 2.052, 2.048, 2.045, 2.042};
  if (freedom <= static_cast<int>(table.size())) return table[static_cast<std::size_t>(freedom) - 1];
  constexpr double z = 1.959964;
  const double z3 = z * z * z;
  const double z5 = z3 * z * z;
  const double n = freedom;
  return z + (z3 + z) / (4.0 * n) + (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * n * n);
}

}  // namespace talus
