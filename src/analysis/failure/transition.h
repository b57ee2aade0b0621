#pragma once
/// The way to failure: the part of a run that leads to it, three estimators of theta_d, the angle at which
/// the packing begins to change as a whole, and the first slide of the surface layer. Input is plain series
/// with ascending angles in rad; if the tilt rises and falls, those of last_rise. Results are NaN if there is
/// no transition.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/quantities.h"
#include "analysis/record.h"
#include "core/observables.h"
#include "core/types.h"

namespace talus::analysis {

// The part of a run that leads to failure, if the tilt rises and falls.

/// A part of a series: elements first ... end - 1.
struct SeriesPart {
  std::size_t first = 0;
  std::size_t end = 0;

  std::size_t size() const { return end - first; }
  /// Returns this part of a series.
  template <typename Series>
  Series slice(const Series& series) const {
    return {series.begin() + static_cast<std::ptrdiff_t>(first),
            series.begin() + static_cast<std::ptrdiff_t>(end)};
  }
};

/// Returns the last part of a series of tilts in which their magnitude rises without falling, including the
/// holds before and after the rise. This is the load under which a slope fails; theta_d and all other
/// quantities searched for up to theta_c refer to it. Returns the entire series if it never falls or never
/// rises.
SeriesPart last_rise(std::span<const double> tilts);

/// Returns the magnitudes of the tilts of a part; they do not decrease.
std::vector<double> magnitudes(std::span<const double> tilts, const SeriesPart& part);

/// Whether the bed slopes backwards at the end of such a part: its tilt is negative.
bool slopes_backwards(std::span<const double> tilts, const SeriesPart& part);

/// The frames of the last rise and the magnitudes of their tilts.
struct FramesOfRise {
  std::size_t first = 0;  ///< number of the first frame of the rise in the run
  std::vector<const FrameRecord*> frames;
  std::vector<double> tilts;  ///< rad
  bool mirrored_slope = false;
};
/// Returns the last rise of the frames of a run.
FramesOfRise last_rise(std::span<const FrameRecord> frames);

/// Whether a frame quantity changes sign if the bed slopes backwards: sigma_T/sigma_N, and the direction of
/// the principal stress to the bed, an axis in (-pi/2, pi/2].
bool has_side(const Quantity& quantity);

/// Returns a number of a frame of such a rise as if the bed were always tilted to the same side: for a bed
/// that slopes backwards, the sign of quantities with a side changes.
double number_on_one_side(const Quantity& quantity, const FrameRecord& frame, std::size_t f,
                          bool mirrored_slope);

/// Returns the observables of the last rise as if the bed were always tilted to the same side: for negative
/// tilts, the tilt, sigma_T/sigma_N and the displacement of the surface change sign.
std::vector<ObservableRow> rows_of_last_rise(std::span<const ObservableRow> rows);

// Scalar results of a run: quantities of the run itself, and of frames at a characteristic place on the way
// to failure, such as p_o at theta_c. Ensembles, studies, the comparison with the paper and `--until` use
// them.

/// The place in a run at which a number is read. The frames are those of the last rise of the tilt. Of
/// several frames at one held tilt, the first counts because later ones may show flow.
enum class Place {
  run,             ///< no place: one number for the run, or one for each threshold
  start,           ///< the first frame
  before_theta_d,  ///< the frame before the jump of l_c max
  theta_d,         ///< the frame after this jump
  percolation,     ///< the first frame from which overloaded grains percolate
  theta_c,         ///< the last frame at or before theta_c
};

/// A scalar result: a quantity, and the place at which it is read.
struct NumberOfRun {
  QuantityMember quantity;
  Place place = Place::run;
};

/// Returns the name, such as "theta_c" or "overloaded/fraction@theta_c".
std::string name_of(const NumberOfRun& number);

/// Returns all scalar results: the quantities of the run in the order of the table of quantities, then those
/// at places.
std::span<const NumberOfRun> numbers_of_run();

/// Tolerance for equal tilts. Tilts are multiples of a step up to rounding; the value suits deg and rad.
inline constexpr double same_tilt = 1e-9;

/// Returns the index of the first of the ascending tilts that equals the last one not after `tilt`; empty if
/// they begin later or `tilt` is NaN.
std::optional<std::size_t> frame_not_after(std::span<const double> tilts, double tilt);

/// Returns the number in the unit of the table of quantities, at threshold f if it depends on one. NaN if the
/// run does not have it: the run has not failed, has no jump, or has no such threshold.
double number_at(const Analysis& analysis, const NumberOfRun& number, std::size_t f = 0);

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
