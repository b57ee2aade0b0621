#pragma once
/// Events of a run in the order of its frames: transitions, failure, and commands.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/command.h"
#include "core/observables.h"
#include "view/frame_values.h"

namespace talus::view {

/// Notable places of a run.
enum class Landmark {
  first,
  theta_d,      ///< transition from contraction to dilation (paper, Fig. 14)
  length_jump,  ///< jump of the largest l_c (paper, Fig. 12b)
  percolation,  ///< first frame in which a cluster of overloaded grains spans from floor to surface
  theta_c,      ///< last frame before the slope fails
  last,
};

/// Name of the event at a landmark, empty for the first and the last frame and the frame before failure, and
/// the landmark as the beginning of a sentence.
struct LandmarkText {
  const char* event;
  const char* sentence;
};
const LandmarkText& text_of(Landmark landmark);

struct TimelineEvent {
  enum class Kind { transition, failure, command, rearrangement };
  std::string name;  ///< also the name of its widget: "dilation", "theta_c", "command 0"
  /// Rich text: "θ_d, volume", or its part before the comma; empty for a command or a rearrangement.
  std::string label;
  std::string what;  ///< rich text: the event and the measure that shows it
  Kind kind = Kind::transition;
  double tilt = 0.0;      ///< rad
  double place = 0.0;     ///< frames from the first, interpolated
  std::size_t frame = 0;  ///< nearest frame
  double time = 0.0;      ///< s; NaN if no row gives it
  double size = 1.0;      ///< value in (0, 1]: for a rearrangement, by the logarithm of its energy
};

/// Data from which events are derived, as far as they are known.
struct TimelineSource {
  std::vector<double> tilts;            ///< rad, one per frame of the tilt
  std::vector<double> times;            ///< s, one per frame of the tilt
  std::span<const ObservableRow> rows;  ///< rows of the tilt
  std::span<const analysis::FrameRecord>
      values;                         ///< records of the first frames of the tilt, with one threshold
  std::span<const Command> commands;  ///< ordered by step
  std::span<const ObservableRow>
      command_rows;  ///< rows_up_to of the entire run, which give the commands a tilt
  std::span<const analysis::EventRecord> rearrangements;  ///< rearrangements of a stored analysis, in order
  double energy_unit = 1.0;                               ///< m g D, J/m
  std::optional<double> theta_c;                          ///< rad
  double mean_diameter = 0.0, cut = 0.0;                  ///< m; l_c is searched up to `cut`
  bool may_change = false;                                ///< more frames will follow
};

/// Returns the position of a tilt among ascending tilts, or of a time among times, in frames, limited to the
/// first and the last; 0 if there are none.
double place_among(std::span<const double> tilts, double tilt);

/// Returns theta_d by each estimator, the jump of l_c, the first spanning cluster, the first slide, theta_c,
/// the rearrangements and the commands, as analyses find them (analysis/failure/transition.h),
/// in order of place. Events that need the values of all frames appear once these are known. Empty without
/// frames. If the tilt rises and falls, events found by angle are those of the last rise.
std::vector<TimelineEvent> timeline_events(const TimelineSource& source);

}  // namespace talus::view
