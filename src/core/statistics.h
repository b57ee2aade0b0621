#pragma once
/// Several values of one quantity: their mean, how wide they spread, and how well the mean is known.

#include <cstdint>
#include <span>
#include <vector>

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

/// The middle of some values, and an interval for their mean that takes no distribution for granted.
struct Summary {
  Statistics statistics;
  double lower_quartile = 0.0, median = 0.0, upper_quartile = 0.0;  ///< NaN for count 0
  double low = 0.0, high = 0.0;  ///< interval of 95 % for the mean; NaN for count < 2
};

/// Draws with replacement of n values out of n, the same ones whenever n is the same.
struct Resamples {
  int values = 0;                    ///< n
  std::vector<std::uint32_t> drawn;  ///< n indices for each draw, draw by draw
};
Resamples resamples_of(int values);

/// From so many values on the interval of a bootstrap is that of Student's t, which takes its place.
inline constexpr int most_resampled = 200;

/// Of the values that are numbers. `resamples` are those of their number, or empty: then the interval is
/// that of Student's t. With them it is the percentile bootstrap (Efron 1979): 2.5 % and 97.5 % of the means
/// of all draws. Quantiles interpolate between the sorted values (type 7 of Hyndman and Fan 1996).
Summary summary_of(std::span<const double> values, const Resamples& resamples);

/// Pearson's coefficient of correlation over the pairs of two numbers, and their count; NaN for fewer than
/// three pairs, or where one side does not vary.
struct Correlation {
  double coefficient = 0.0;
  int count = 0;
};
Correlation correlation_of(std::span<const double> left, std::span<const double> right);

/// Of values[k] - baseline[k], pair by pair, over the pairs of two numbers. Both have the same length, one
/// value for each seed. A deviation that is no more than round-off is 0, and so is the error.
Statistics paired_difference(std::span<const double> values, std::span<const double> baseline);

/// Two-sided quantile of Student's t distribution at 95 %, freedom >= 1 (Abramowitz and Stegun 1964, table
/// 26.10; from 31 degrees on their expansion 26.7.5 to n^-2, within 1e-4).
double student_t(int freedom);

/// What can be said of a difference at a confidence of 95 %.
enum class Verdict {
  unknown,       ///< fewer than two pairs, or all differ by the same: that says nothing of its error
  within_error,  ///< zero lies in the interval
  differs,
};
Verdict verdict(const Statistics& difference);

}  // namespace talus
