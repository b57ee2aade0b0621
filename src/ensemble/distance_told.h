#pragma once
/// How far from failure a bed is, told by what is measured in it: how well does a measure do that was
/// calibrated with other beds?

#include <span>
#include <vector>

namespace talus {

/// A measure in several beds at the same distances from failure, bed by bed; NaN where there is none.
using BedCurves = std::vector<std::vector<double>>;

/// What a bed's own measures, read off at one instant, tell of its distance from failure.
struct DistanceTold {
  std::vector<double> mean_square;  ///< error of each bed over its distances, deg^2; NaN where none is told
  std::vector<double> error;        ///< root mean square error over the beds at each distance, deg; or NaN
  std::size_t beds = 0;             ///< that have any
};

/// Fewer beds than these calibrate nothing.
inline constexpr std::size_t fewest_to_calibrate = 5;

/// For each bed and each distance, the distance that one or two measures tell an observer who knows all other
/// beds (leave-one-out), and its error. At each distance the measures of the other beds are taken for
/// normally distributed, with their mean, and their covariance over the beds; all `distances` (deg,
/// equally spaced) are taken for equally likely beforehand; what is told is the mean of the distance after
/// the measure is known (Bayes), which has the least mean square error there is. Measures that say nothing
/// thus have the standard deviation of the distances themselves. The deviation of a measure at one distance
/// is not taken below a hundredth of that over all. Nothing is told by a measure that does not vary at all,
/// or that fewer than fewest_to_calibrate other beds have at some distance.
DistanceTold distance_told(std::span<const double> distances, const BedCurves& measure);
DistanceTold distance_told(std::span<const double> distances, const BedCurves& first,
                           const BedCurves& second);

/// A root mean square with its standard error, from mean squares of beds, which are independent of each
/// other; NaN for fewer than two.
struct RootMeanSquare {
  double value = 0.0, error = 0.0;
};
RootMeanSquare root_mean_square(std::span<const double> mean_squares);

}  // namespace talus
