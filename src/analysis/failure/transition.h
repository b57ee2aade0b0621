#pragma once
/// Three estimators of theta_d, the angle at which the packing begins to change as a whole, and the first
/// slide of the surface layer. Input is plain series with ascending angles in rad; if the tilt rises and
/// falls, those of last_rise. Results are NaN if there is no transition.

#include <span>

#include "core/types.h"

namespace talus::analysis {

/// The jump of the largest coarse-graining length (paper, Fig. 12b).
struct LengthJump {
  double tilt = 0.0;   ///< tilt of the frame after the largest increase between two frames
  double error = 0.0;  ///< difference in tilt between these frames
  double size = 0.0;   ///< the increase, in the unit of `lengths`
};
/// Finds the jump among the frames up to theta_c, or all frames if it is NaN, and up to the first frame whose
/// length reaches `cut`, beyond which lengths are unknown. There is no jump if the length never increases.
LengthJump length_jump(std::span<const double> tilts, std::span<const double> lengths, double theta_c,
                       double cut);

/// The onset of percolation of overloaded grains (paper, section V B).
struct PercolationOnset {
  /// Tilt of the first frame up to theta_c from which a cluster spans the bed for at least 3 frames.
  double tilt = 0.0;
  /// Difference in tilt from the preceding frame; NaN for the first frame: theta_d is at or below it.
  double error = 0.0;
};
/// Finds the onset. `spans` is nonzero for each frame in which a cluster spans the bed.
PercolationOnset percolation_onset(std::span<const double> tilts, std::span<const Index> spans,
                                   double theta_c);

/// The transition from contraction to dilation (paper, Fig. 14).
struct DilationOnset {
  double tilt = 0.0;  ///< tilt of the smallest running mean of the strain, over `window`, up to theta_c
  /// Range of tilt around it in which the running mean exceeds its minimum by at most the noise, the rms
  /// deviation of the strain from the mean.
  double low = 0.0;
  double high = 0.0;
};
/// Window of dilation_onset in analyses, deg.
inline constexpr double dilation_window = 1.0;

/// Finds the onset. The running mean extends over window/2 on either side, and symmetrically over less near
/// the ends. There is no onset if the range reaches the end, that is, if the strain has not risen by more
/// than the noise.
DilationOnset dilation_onset(std::span<const double> tilts, std::span<const double> strains, double theta_c,
                             double window);

/// Divergence of a size towards failure: size = b (theta_c - theta)^-exponent.
struct GrowthExponent {
  double exponent = 0.0;
  double error = 0.0;  ///< standard error from the scatter around the line, for independent frames
};
/// Window of growth_exponent before theta_c in analyses, deg.
inline constexpr double growth_window = 10.0;

/// Fits the logarithm of the sizes against that of theta_c - theta by least squares, for 0 < theta_c - theta
/// <= `window` (rad); sizes that are 0 or NaN are left out. NaN with fewer than 5 sizes.
GrowthExponent growth_exponent(std::span<const double> tilts, std::span<const double> sizes, double theta_c,
                               double window);

/// Definition of a slide: downslope displacement of the surface layer, in mean diameters, and the range of
/// tilt in which it occurs, in deg.
inline constexpr double slide_distance = 0.5;
inline constexpr double slide_window = 0.5;

/// Returns the first tilt after which the surface layer moves by `distance` within `window` (rad). A slide
/// may stop again. The sustained flow is a slide as well, so the result exceeds theta_c by at most the
/// window. `displacements` are those of the surface layer since the beginning, in the unit of `distance`.
double first_slide(std::span<const double> tilts, std::span<const double> displacements, double distance,
                   double window);

}  // namespace talus::analysis
