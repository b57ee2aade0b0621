#pragma once
/// What happened in a run, in the order of its frames: where it changes, fails, and what was done to it.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/command.h"
#include "core/observables.h"
#include "view/bookmarks.h"
#include "view/frame_values.h"

namespace talus::view {

/// Places of a run worth going to.
enum class Landmark {
  first,
  theta_d,      ///< where contraction turns into dilation (paper, Fig. 14)
  length_jump,  ///< where the largest l_c jumps (paper, Fig. 12b)
  percolation,  ///< the first frame in which a cluster of overloaded grains spans from floor to surface
  theta_c,      ///< the last frame before the slope fails
  last,
};

/// The name of the event that is there; empty for the first and the last frame and that before failure.
std::string_view event_name(Landmark landmark);

struct TimelineEvent {
  enum class Kind { transition, failure, command, rearrangement, bookmark };
  std::string name;   ///< "dilation", "theta_c", "command 0": also the name of its widget
  std::string label;  ///< rich text, short: "θ_d"; empty for a command, a rearrangement, a bookmark
  std::string what;   ///< rich text: what happens, by which measure; of a bookmark its note, as it is
  Kind kind = Kind::transition;
  double tilt = 0.0;      ///< rad
  double place = 0.0;     ///< frames from the first one, between two of them
  std::size_t frame = 0;  ///< the nearest
  double size = 1.0;      ///< in (0, 1]: of a rearrangement, by the logarithm of its energy
  double time = 0.0;      ///< s; NaN where no row tells
};

/// What the events follow from, as far as it is known.
struct TimelineSource {
  std::vector<double> tilts;                      ///< rad, of the frames of the tilt
  std::vector<double> times;                      ///< s, of the same
  std::span<const ObservableRow> rows;            ///< of the tilt
  std::span<const analysis::FrameRecord> values;  ///< of the first frames of the tilt, with one threshold
  std::span<const Command> commands;              ///< in their order
  std::span<const ObservableRow> command_rows;    ///< rows_up_to of the whole run, by which they have a tilt
  std::span<const analysis::EventRecord> rearrangements;  ///< of a stored analysis, in their order
  std::span<const Bookmark> bookmarks;                    ///< in their order
  std::vector<double> all_times;                          ///< s, of all frames, also of those after failure
  double energy_unit = 1.0;                               ///< m g D, J/m
  std::optional<double> theta_c;                          ///< rad
  double mean_diameter = 0.0, cut = 0.0;                  ///< m; l_c is searched for up to the second
  bool may_change = false;                                ///< more frames will come
};

/// Where a tilt is among ascending tilts, or a time among times, in frames; not beyond the first and the
/// last. 0 for none.
double place_among(std::span<const double> tilts, double tilt);

/// theta_d by each estimator, the jump of l_c, where a cluster first spans, the first slide, theta_c, the
/// rearrangements, the commands and the bookmarks, as analyses find them (analysis/failure/transition.h), in
/// the order of their places. What needs the values of all frames comes when they are there. None where there
/// are no frames. Where the tilt goes up and down, what is found at an angle is of the last rise.
std::vector<TimelineEvent> timeline_events(const TimelineSource& source);

}  // namespace talus::view
