#pragma once
/// Means over seeds and their errors.

#include <span>

namespace talus {

/// Mean and standard error (s / sqrt(n), s with n - 1) of the values that are numbers; values that are NaN do
/// not count.
struct MeanError {
  int count = 0;
  double mean = 0.0;   ///< NaN for count 0
  double error = 0.0;  ///< NaN for count < 2
};
MeanError mean_error(std::span<const double> values);

/// Mean and standard error of values[k] - baseline[k], pair by pair, over the pairs of two numbers. Both have
/// the same length, one value for each seed.
MeanError paired_difference(std::span<const double> values, std::span<const double> baseline);

/// Two-sided quantile of Student's t distribution at 95 %, freedom >= 1 (Abramowitz and Stegun 1964, table
/// 26.10; from 31 degrees on their expansion 26.7.5 to n^-2, within 1e-4).
double student_t(int freedom);

/// What can be said of a difference at a confidence of 95 %.
enum class Verdict {
  unknown,       ///< fewer than two pairs: it has no error
  within_error,  ///< zero lies within student_t standard errors
  differs,
};
Verdict verdict(const MeanError& difference);

}  // namespace talus
