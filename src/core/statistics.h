#pragma once
/// Statistics of several values of one quantity: mean, spread, and error of the mean.

#include <span>
#include <vector>

namespace talus {

/// Statistics of the values that are not NaN, summed in their order.
struct Statistics {
  int count = 0;
  double mean = 0.0;       ///< NaN for count 0
  double deviation = 0.0;  ///< standard deviation s, with n - 1; NaN for count < 2
  double error = 0.0;      ///< standard error of the mean, s / sqrt(n); NaN for count < 2

  /// Returns half the width of the 95 % confidence interval of the mean (Student's t); NaN for count < 2.
  double interval() const;
};
Statistics statistics_of(std::span<const double> values);

/// Statistics of the values that are not NaN, the 95 % confidence interval of their mean, and their
/// quartiles, which interpolate between the sorted values (type 7 of Hyndman and Fan 1996).
struct Summary {
  Statistics statistics;
  double lower_quartile = 0.0, median = 0.0, upper_quartile = 0.0;  ///< NaN for count 0
  double low = 0.0, high = 0.0;  ///< mean -+ statistics.interval(); NaN for count < 2
};
Summary summary_of(std::span<const double> values);

/// Pearson's coefficient of correlation over the pairs without NaN, and their number. The coefficient is NaN
/// for fewer than three pairs, or if one side does not vary.
struct Correlation {
  double coefficient = 0.0;
  int count = 0;
};
Correlation correlation_of(std::span<const double> left, std::span<const double> right);

/// Returns the two-sided quantile of Student's t distribution at 95 %, freedom >= 1 (Abramowitz and Stegun
/// 1964, table 26.10; from 31 degrees of freedom on their expansion 26.7.5 to n^-2, within 1e-4).
double student_t(int freedom);

}  // namespace talus
