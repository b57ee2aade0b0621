#pragma once
/// Rearrangements of a bed: bursts of motion separated by quiet periods, and the grains that move in each.

#include <span>
#include <vector>

#include "core/snapshot.h"
#include "core/types.h"

namespace talus::analysis {

// Distributions of sizes and waiting angles: maximum-likelihood exponents and their standard errors.

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

/// A burst of motion, given by indices into a series of steps.
struct Burst {
  std::size_t first = 0;  ///< the first step at or above the threshold
  std::size_t last = 0;   ///< the last such step before a quiet period or the end of the series
  bool is_over = false;   ///< whether a quiet period has followed
};

/// Returns the bursts of a series of velocities in order: steps at or above `threshold`, separated by fewer
/// than `quiet_steps` consecutive slower ones. quiet_steps >= 1. NaN counts as slow.
std::vector<Burst> find_bursts(std::span<const double> velocities, double threshold, std::size_t quiet_steps);

/// Returns the median of the velocities outside all bursts, due to solver residuals and slow rearrangement.
/// NaN if there are none.
double quiet_velocity(std::span<const double> velocities, std::span<const Burst> bursts);

/// Returns the displacement of the centre of mass of the free grains, m.
Vec2 mean_displacement(const Frame& before, const Frame& after, const RunStatics& statics);

/// Returns the work of gravity for a mean displacement of the free grains (m) at a tilt (rad), J per metre of
/// thickness: M g (sin(theta) dx - cos(theta) dy). Between two states at rest, contacts dissipate this
/// released potential energy. The work of rotating the bed is not included.
double gravity_work(const RunStatics& statics, Vec2 displacement, double tilt);

/// The grains displaced between two frames.
struct Movement {
  Index grains = 0;          ///< number of free grains displaced by `least` or more
  double depth = not_known;  ///< depth below `surface`, m, above which 95 % of the displacement lies
  Vec2 centre = {not_known, not_known};  ///< mean of the initial positions, weighted by displacement, m
};

/// Finds the displaced grains. `least` and the height `surface` of the mean free surface are in m. In a
/// periodic bed, x of the centre is a circular mean in [0, length).
Movement movement_between(const Frame& before, const Frame& after, const RunStatics& statics, double least,
                          double surface);

}  // namespace talus::analysis
