#pragma once
/// The part of a run that leads to failure, if the tilt rises and falls.

#include <cstddef>
#include <span>
#include <vector>

#include "analysis/quantities.h"
#include "analysis/record.h"
#include "core/observables.h"

namespace talus::analysis {

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

}  // namespace talus::analysis
