#pragma once
/// Distributions of sizes and waiting angles: maximum-likelihood exponents and their standard errors.

#include <span>

#include "core/types.h"

namespace talus::analysis {

/// Smallest number of values for an exponent. With fewer, its standard error is about a third of alpha - 1 or
/// more.
inline constexpr int min_fitted_values = 10;

/// A continuous power law, density ~ x^-alpha for x >= `minimum` (Clauset, Shalizi and Newman 2009, Eqs. 3.1,
/// 3.2 and 3.9).
struct PowerLaw {
  double exponent = not_known;  ///< alpha = 1 + n / sum of ln(x / minimum)
  double error = not_known;     ///< standard error, (alpha - 1) / sqrt(n)
  double minimum = not_known;   ///< lower end of the law, in the unit of the values
  int count = 0;                ///< n, values at or above the minimum
  double distance = not_known;  ///< Kolmogorov-Smirnov distance between the two cumulative distributions

  /// Returns the share of the values from `minimum` upwards that are at least x, according to the law.
  double share_from(double x) const;
};

/// Fits the values at or above `minimum` > 0. The exponent is NaN with fewer than min_fitted_values values
/// or if all are equal; the count is set in any case.
PowerLaw power_law_from(std::span<const double> values, double minimum);

/// Fits with the value as minimum that gives the smallest distance, among those that leave at least
/// min_fitted_values values (Clauset, Shalizi and Newman 2009, section 3.3). Values that are not positive
/// are ignored.
PowerLaw power_law(std::span<const double> values);

/// An exponential law of waiting angles.
struct ExponentialLaw {
  double mean = not_known;
  double error = not_known;  ///< standard error, mean / sqrt(n), if the law holds
  int count = 0;
};

/// Fits the values at or above `minimum`, ignoring NaN. The minimum is subtracted from them because shorter
/// values cannot be resolved. The mean is NaN with fewer than min_fitted_values values.
ExponentialLaw exponential_law(std::span<const double> values, double minimum);

}  // namespace talus::analysis
