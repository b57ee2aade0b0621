#pragma once
/// Several values of one quantity: their mean, how wide they spread, and how well the mean is known.

#include <span>

namespace talus {

/// Of the values that are numbers, summed in their order; values that are NaN do not count.
struct Statistics {
  int count = 0;
  double mean = 0.0;       ///< NaN for count 0
  double deviation = 0.0;  ///< standard deviation s, with n - 1; NaN for count < 2
  double error = 0.0;      ///< standard error of the mean, s / sqrt(n); NaN for count < 2

  /// Half the width of the interval of 95 % confidence around the mean (Student's t); NaN for count < 2.
  double interval() const;
};
Statistics statistics_of(std::span<const double> values);

/// Of values[k] - baseline[k], pair by pair, over the pairs of two numbers. Both have the same length, one
/// value for each seed.
Statistics paired_difference(std::span<const double> values, std::span<const double> baseline);

/// Two-sided quantile of Student's t distribution at 95 %, freedom >= 1 (Abramowitz and Stegun 1964, table
/// 26.10; from 31 degrees on their expansion 26.7.5 to n^-2, within 1e-4).
double student_t(int freedom);

/// What can be said of a difference at a confidence of 95 %.
enum class Verdict {
  unknown,       ///< fewer than two pairs: it has no error
  within_error,  ///< zero lies in the interval
  differs,
};
Verdict verdict(const Statistics& difference);

}  // namespace talus
