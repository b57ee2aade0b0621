#include "core/statistics.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace talus {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double Statistics::interval() const { return count < 2 ? none : student_t(count - 1) * error; }

Statistics statistics_of(std::span<const double> values) {
  Statistics result{0, none, none, none};
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

Statistics paired_difference(std::span<const double> values, std::span<const double> baseline) {
  std::vector<double> differences(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) differences[k] = values[k] - baseline[k];
  return statistics_of(differences);
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

Verdict verdict(const Statistics& difference) {
  if (difference.count < 2) return Verdict::unknown;
  return std::abs(difference.mean) <= difference.interval() ? Verdict::within_error : Verdict::differs;
}

}  // namespace talus
