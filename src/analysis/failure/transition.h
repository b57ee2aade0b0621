#pragma once
/// theta_d, the angle at which the packing begins to change as a whole, by three estimators, and the first
/// slide of the surface layer. Plain series; angles in rad, ascending (of a run whose tilt goes up and down
/// those of its last_rise); NaN where there is no transition.

#include <span>

#include "core/types.h"

namespace talus::analysis {

/// Where the largest coarse-graining length jumps (paper, Fig. 12b).
struct LengthJump {
  double tilt = 0.0;   ///< of the frame after the largest increase between two frames
  double error = 0.0;  ///< spacing of the two
  double size = 0.0;   ///< of the increase, in the unit of `lengths`
};
/// Looks at frames up to theta_c, all where it is NaN, and up to the first whose length reaches `cut`: beyond
/// it lengths are not known. No jump where the length never increases.
LengthJump length_jump(std::span<const double> tilts, std::span<const double> lengths, double theta_c,
                       double cut);

/// Where overloaded grains begin to percolate (paper, section V B).
struct PercolationOnset {
  double tilt = 0.0;   ///< of the first frame up to theta_c from which on a cluster spans, 3 frames at least
  double error = 0.0;  ///< spacing from the frame before; NaN for the first frame: theta_d is not above it
};
/// `spans`: frame by frame, 0 or not.
PercolationOnset percolation_onset(std::span<const double> tilts, std::span<const Index> spans,
                                   double theta_c);

/// Where contraction turns into dilation (paper, Fig. 14).
struct DilationOnset {
  double tilt = 0.0;  ///< of the smallest strain up to theta_c, in a mean over `window`
  double low = 0.0;   ///< the range around it in which the mean is not above its minimum by more than the
  double high = 0.0;  ///< noise, which is the rms deviation of the strain from the mean
};
/// deg, the window of dilation_onset in analyses.
inline constexpr double dilation_window = 1.0;

/// The mean is over window/2 on either side, less near the ends, where it stays symmetric. No onset where the
/// range reaches the end: the strain has not risen by more than the noise.
DilationOnset dilation_onset(std::span<const double> tilts, std::span<const double> strains, double theta_c,
                             double window);

/// How a size diverges towards failure: size = b (theta_c - theta)^-exponent.
struct GrowthExponent {
  double exponent = 0.0;
  double error = 0.0;  ///< standard, from the scatter around the line, as if frames were independent
};
/// deg before theta_c, the window of growth_exponent in analyses.
inline constexpr double growth_window = 10.0;

/// Least squares of the logarithm of the sizes over that of theta_c - theta, which is above 0 and not above
/// `window` (rad); sizes that are not known are left out. NaN with fewer than 5 of them.
GrowthExponent growth_exponent(std::span<const double> tilts, std::span<const double> sizes, double theta_c,
                               double window);

/// What counts as a slide: mean diameters by which the surface layer moves downslope, and degrees of tilt
/// within which it does.
inline constexpr double slide_distance = 0.5;
inline constexpr double slide_window = 0.5;

/// Where the surface layer slides first: the first tilt after which it moves by `distance` within `window`
/// (rad). A slide may stop; the flow that does not is a slide as well, so this is not above theta_c but for
/// the window. `displacements` of the surface layer since the beginning, in the unit of `distance`.
double first_slide(std::span<const double> tilts, std::span<const double> displacements, double distance,
                   double window);

}  // namespace talus::analysis
