#pragma once
/// The part of a run that leads to failure, where its tilt goes up and down.

#include <cstddef>
#include <span>
#include <vector>

#include "analysis/quantities.h"
#include "analysis/record.h"
#include "core/observables.h"

namespace talus::analysis {

/// A part of a series: places first ... end - 1.
struct SeriesPart {
  std::size_t first = 0;
  std::size_t end = 0;

  std::size_t size() const { return end - first; }
  /// The part of a series of that length.
  template <typename Series>
  Series of(const Series& series) const {
    return {series.begin() + static_cast<std::ptrdiff_t>(first),
            series.begin() + static_cast<std::ptrdiff_t>(end)};
  }
};

/// The last part of a series of tilts in which their magnitude rises and does not fall, with the holds before
/// and after the rise: the load under which a slope fails, and what theta_d and what else is looked for up to
/// theta_c refer to. All of a series that never falls, and of one that never rises.
SeriesPart last_rise(std::span<const double> tilts);

/// The magnitudes of the tilts of a part, which do not fall.
std::vector<double> magnitudes(std::span<const double> tilts, const SeriesPart& part);

/// Whether the bed slopes to the other side at the end of such a part: its tilt is below 0.
bool is_to_other_side(std::span<const double> tilts, const SeriesPart& part);

/// The last rise of frames, and the magnitudes of their tilts.
struct FramesOfRise {
  std::size_t first = 0;  ///< the number of its first frame
  std::vector<const FrameRecord*> frames;
  std::vector<double> tilts;  ///< rad
  bool other_side = false;
};
FramesOfRise last_rise(std::span<const FrameRecord> frames);

/// Whether a number of frames has the other sign where the bed slopes to the other side.
bool has_side(const Quantity& quantity);

/// A number of a frame of such a rise as if the bed were always tilted to one side: sigma_T/sigma_N has the
/// other sign, and a direction to the bed is mirrored.
double number_on_one_side(const Quantity& quantity, const FrameRecord& frame, std::size_t f, bool other_side);

/// The last rise of rows of observables, as if the bed were always tilted to one side: where the tilt is
/// below 0, it, sigma_T/sigma_N and the displacement of the surface have the other sign.
std::vector<ObservableRow> rows_of_last_rise(std::span<const ObservableRow> rows);

}  // namespace talus::analysis
