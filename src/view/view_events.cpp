/// Events of the run shown.

#include <algorithm>
#include <cmath>

#include "pictures/frame_choice.h"
#include "runs/event_catalogue.h"
#include "session/command.h"
#include "view/view_model.h"

namespace talus::view {

void ViewModel::find_events() {
  TimelineSource source;
  source.tilts = tilts_of_tilt();
  source.times = times_of_tilt();
  source.rows = rows_;
  source.values = series_->values();
  const std::vector<Command> given = session::given_commands(commands_);
  source.commands = given;
  const std::vector<ObservableRow> live_rows =
      live_ && !given.empty() ? session::rows_up_to(rows_, newest_->step, newest_->time, newest_->tilt)
                              : std::vector<ObservableRow>();
  source.command_rows = live_ ? live_rows : file_rows_;
  if (analysis_) source.rearrangements = analysis_->events;
  source.energy_unit =
      runs::mean_grain_mass(all_statics_) * all_statics_.gravity * all_statics_.mean_diameter;
  source.theta_c = theta_c_;
  source.mean_diameter = statics().mean_diameter;
  source.cut = analysis::length_cut(statics(), series_->rule().l_min);
  source.may_change = live_ && !live_->status().done;
  events_ = timeline_events(source);
}

std::optional<std::size_t> ViewModel::place_of(Landmark landmark) const {
  const std::vector<double> tilts = tilts_of_tilt();
  if (tilts.empty()) return std::nullopt;
  if (landmark == Landmark::first) return 0;
  if (landmark == Landmark::last) return frame_count() - 1;
  if (landmark == Landmark::theta_c) {
    if (!theta_c_ || std::abs(tilts.front()) > *theta_c_) return std::nullopt;
    return pictures::frame_at_repose(tilts, *theta_c_);
  }
  const auto event = std::ranges::find(events_, event_name(landmark), &TimelineEvent::name);
  return event == events_.end() ? std::nullopt : std::optional(event->frame);
}

}  // namespace talus::view
