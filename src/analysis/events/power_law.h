#pragma once
/// Distributions of sizes and of waits: exponents by maximum likelihood, with their errors.

#include <span>

#include "core/types.h"

namespace talus::analysis {

/// From so few values on an exponent is told; fewer leave it open within a third or more of alpha - 1.
inline constexpr int fewest_to_tell = 10;

/// A continuous power law, density ~ x^-alpha from `minimum` on (Clauset, Shalizi and Newman 2009, Eqs. 3.1,
/// 3.2 and 3.9).
struct PowerLaw {
  double exponent = not_known;  ///< alpha = 1 + n / sum of ln(x / minimum)
  double error = not_known;     ///< (alpha - 1) / sqrt(n), standard
  double minimum = not_known;   ///< where the law begins, in the unit of the values
  int count = 0;                ///< n, values from there on
  double distance = not_known;  ///< Kolmogorov-Smirnov: the largest between both cumulative distributions

  /// Share of the values from `minimum` on that are x or larger, by the law.
  double share_from(double x) const;
};

/// Of the values from `minimum` > 0 on. The exponent is NaN with fewer than fewest_to_tell of them, or where
/// all are equal; the count is there all the same.
PowerLaw power_law_from(std::span<const double> values, double minimum);

/// With that value for a minimum from which on the distance is smallest, of those that leave fewest_to_tell
/// values (Clauset, Shalizi and Newman 2009, section 3.3). Values that are not above 0 do not count.
PowerLaw power_law(std::span<const double> values);

/// An exponential law of waits.
struct ExponentialLaw {
  double mean = not_known;
  double error = not_known;  ///< mean / sqrt(n), standard, which holds if the law does
  int count = 0;
};

/// Of the values that are numbers, from `minimum` on, which is taken off them: shorter ones cannot be told.
/// The mean is NaN with fewer than fewest_to_tell.
ExponentialLaw exponential_law(std::span<const double> values, double minimum);

}  // namespace talus::analysis
