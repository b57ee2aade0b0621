#pragma once
/// Statistics of several values of one quantity: mean, spread, and error of the mean.

#include <cstdint>
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

/// Quartiles of some values, and a confidence interval of their mean that assumes no distribution.
struct Summary {
  Statistics statistics;
  double lower_quartile = 0.0, median = 0.0, upper_quartile = 0.0;  ///< NaN for count 0
  double low = 0.0, high = 0.0;  ///< 95 % confidence interval of the mean; NaN for count < 2
};

/// Draws of n values out of n with replacement. The draws depend on n alone.
struct Resamples {
  int values = 0;                    ///< n
  std::vector<std::uint32_t> drawn;  ///< n indices for each draw, draw by draw
};
Resamples resamples_of(int values);

/// Largest number of values that are resampled. For more values the bootstrap interval hardly differs from
/// that of Student's t, which is used instead.
inline constexpr int max_resampled = 200;

/// Returns the summary of the values that are not NaN. `resamples` are those of their number, or empty. With
/// them the interval is the percentile bootstrap (Efron 1979), from 2.5 % to 97.5 % of the means of all
/// draws; without them it is that of Student's t. Quantiles interpolate between the sorted values (type 7 of
/// Hyndman and Fan 1996).
Summary summary_of(std::span<const double> values, const Resamples& resamples);

/// Pearson's coefficient of correlation over the pairs without NaN, and their number. The coefficient is NaN
/// for fewer than three pairs, or if one side does not vary.
struct Correlation {
  double coefficient = 0.0;
  int count = 0;
};
Correlation correlation_of(std::span<const double> left, std::span<const double> right);

/// Returns the statistics of values[k] - baseline[k] over the pairs without NaN. Both arrays have the same
/// length, one value for each seed. If the deviation is within round-off, deviation and error are 0.
Statistics paired_difference(std::span<const double> values, std::span<const double> baseline);

/// Returns the two-sided quantile of Student's t distribution at 95 %, freedom >= 1 (Abramowitz and Stegun
/// 1964, table 26.10; from 31 degrees of freedom on their expansion 26.7.5 to n^-2, within 1e-4).
double student_t(int freedom);

/// Significance of a difference at 95 % confidence.
enum class Verdict {
  unknown,       ///< fewer than two pairs, or all differ by the same amount, so that the error is unknown
  within_error,  ///< zero lies in the interval
  differs,
};
Verdict verdict(const Statistics& difference);

}  // namespace talus
