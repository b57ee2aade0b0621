#include "view/timeline.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "analysis/failure/transition.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "session/command.h"

namespace talus::view {
namespace {

std::vector<double> column_of(std::span<const ObservableRow> rows, Observable field) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const ObservableRow& row : rows) values.push_back(at(row, field));
  return values;
}

/// Collects the events that have a tilt.
struct EventList {
  const TimelineSource& source;
  std::size_t rise_begins;                   ///< frame
  std::vector<double> rise_tilts;            ///< rad, absolute values
  bool mirrored_slope;                       ///< whether the bed slopes backwards in the rise
  std::vector<ObservableRow> rows;           ///< those of the rise
  std::vector<double> row_tilts, row_times;  ///< their absolute tilts (rad) and times (s)
  std::vector<TimelineEvent> events;

  explicit EventList(const TimelineSource& timeline_source) : source(timeline_source) {
    const analysis::SeriesPart rise = analysis::last_rise(timeline_source.tilts);
    rise_begins = rise.first;
    rise_tilts = analysis::magnitudes(timeline_source.tilts, rise);
    mirrored_slope = analysis::slopes_backwards(timeline_source.tilts, rise);
    rows = analysis::rows_of_last_rise(timeline_source.rows);
    row_tilts = column_of(rows, Observable::tilt);
    row_times = column_of(rows, Observable::time);
  }

  /// Adds an event of the last rise, at a tilt of that magnitude (rad).
  void add(const char* name, const char* label, const std::string& what, double tilt,
           TimelineEvent::Kind kind = TimelineEvent::Kind::transition) {
    if (!std::isfinite(tilt)) return;
    add_at(name, label, what, mirrored_slope ? -tilt : tilt,
           static_cast<double>(rise_begins) + place_among(rise_tilts, tilt), time_of(tilt), kind);
  }

  /// Returns the time (s) at which the last rise reaches a tilt (rad), interpolated between two rows.
  double time_of(double tilt) const {
    if (row_tilts.empty()) return not_known;
    const double place = place_among(row_tilts, tilt);
    const auto before = static_cast<std::size_t>(place);
    const std::size_t after = std::min(before + 1, row_times.size() - 1);
    return std::lerp(row_times[before], row_times[after], place - std::floor(place));
  }

  void add_at(const std::string& name, const char* label, const std::string& what, double tilt, double place,
              double time, TimelineEvent::Kind kind) {
    const auto frame = static_cast<std::size_t>(std::lround(place));
    events.push_back({name, label, what, kind, tilt, place, frame, time});
  }

  /// Adds an event at a tilt (rad) and a time (s), in any rise.
  void add_timed(const std::string& name, const std::string& what, double tilt, double time,
                 TimelineEvent::Kind kind) {
    const double place = std::ranges::is_sorted(source.tilts) ? place_among(source.tilts, tilt)
                                                              : place_among(source.times, time);
    add_at(name, "", what, tilt, place, time, kind);
  }

  void add_command(std::size_t k) {
    const Command& command = source.commands[k];
    const double tilt = session::tilt_before(command, source.commands, source.command_rows);
    const double time = session::time_before(command, source.command_rows);
    const bool in_deposition = std::isnan(tilt);  // its place is the beginning of the line
    add_timed(fmt::format("command {}", k), session::command_text(command),
              in_deposition ? source.tilts.front() : tilt,
              in_deposition && !source.times.empty() ? source.times.front() : time,
              TimelineEvent::Kind::command);
  }
};

void add_of_rows(EventList& list, double theta_c) {
  const std::vector<double>& tilts = list.row_tilts;
  const auto onset = [&](Observable strain) {
    return analysis::dilation_onset(tilts, column_of(list.rows, strain), theta_c,
                                    radians(analysis::dilation_window))
        .tilt;
  };
  list.add("dilation", "θ_d, volume", "the volume begins to grow", onset(Observable::volume_strain));
  list.add("centre of mass", "θ_d, centre of mass", "the centre of mass begins to rise",
           onset(Observable::centre_of_mass_strain));
  list.add("first slide", "slide", "the surface layer slides first",
           analysis::first_slide(tilts, column_of(list.rows, Observable::surface_displacement),
                                 analysis::slide_distance * list.source.mean_diameter,
                                 radians(analysis::slide_window)));
}

void add_of_frames(EventList& list, double theta_c) {
  const TimelineSource& source = list.source;
  const auto first = std::ranges::find_if(source.values, [](const analysis::FrameRecord& frame) {
    return frame.thresholds.front().spans_depth != 0;
  });
  if (const auto k = static_cast<std::size_t>(first - source.values.begin()); k < source.values.size())
    list.add_at("spans", "spans", "a cluster first spans from floor to surface", first->tilt,
                static_cast<double>(k), k < source.times.size() ? source.times[k] : not_known,
                TimelineEvent::Kind::transition);
  if (source.may_change || source.values.size() < source.tilts.size()) return;
  const auto [begin, frames, tilts, mirrored_slope] = analysis::last_rise(source.values);
  std::vector<double> lengths;
  std::vector<Index> spans;
  for (const analysis::FrameRecord* frame : frames) {
    lengths.push_back(frame->thresholds.front().lc_max);
    spans.push_back(frame->thresholds.front().spans_depth);
  }
  list.add("length jump", "ℓ_c", "the largest ℓ_c jumps",
           analysis::length_jump(tilts, lengths, theta_c, source.cut).tilt);
  list.add("percolation", "θ_d, clusters", "clusters percolate from here on",
           analysis::percolation_onset(tilts, spans, theta_c).tilt);
}

/// Decades of energy over which sizes differ, and the size of all smaller rearrangements.
constexpr double labelled_decades = 4.0;
constexpr double min_size = 0.2;

/// Adds the rearrangements except the flow that ends the slope, which theta_c marks.
void add_rearrangements(EventList& list) {
  std::vector<analysis::EventRecord> chosen(list.source.rearrangements.begin(),
                                            list.source.rearrangements.end());
  std::erase_if(chosen, [](const analysis::EventRecord& event) {
    return event.kind == static_cast<Index>(analysis::EventKind::failure) || !std::isfinite(event.begin);
  });
  double largest = 0.0;
  for (const analysis::EventRecord& event : chosen) largest = std::fmax(largest, event.energy);
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const analysis::EventRecord& event = chosen[k];
    list.add_timed(fmt::format("rearrangement {}", k),
                   fmt::format("rearrangement, {:.3g} m g D, {} moved; the bed {}",
                               event.energy / list.source.energy_unit,
                               counted(static_cast<std::size_t>(event.grains), "grain"),
                               event.centre_of_mass_strain > 0.0 ? "dilates" : "contracts"),
                   event.begin, event.time, TimelineEvent::Kind::rearrangement);
    const double below = std::log10(largest / event.energy) / labelled_decades;
    list.events.back().size = std::isfinite(below) ? std::clamp(1.0 - below, min_size, 1.0) : min_size;
  }
}

}  // namespace

const LandmarkText& text_of(Landmark landmark) {
  static constexpr LandmarkText texts[] = {
      {"", "The first frame"},
      {"dilation", "The frame at which the volume begins to grow"},
      {"length jump", "The frame at which the largest coarse-graining length jumps"},
      {"spans", "The frame in which a cluster first spans from floor to surface"},
      {"", "The last frame before failure"},
      {"", "The last frame"}};
  return texts[static_cast<std::size_t>(landmark)];
}

double place_among(std::span<const double> tilts, double tilt) {
  const auto after = std::ranges::lower_bound(tilts, tilt);
  if (after == tilts.begin()) return 0.0;
  if (after == tilts.end()) return static_cast<double>(tilts.size() - 1);
  const double before = *(after - 1);
  return static_cast<double>(after - tilts.begin()) - (*after - tilt) / (*after - before);
}

std::vector<TimelineEvent> timeline_events(const TimelineSource& source) {
  if (source.tilts.empty()) return {};
  EventList list(source);
  const double theta_c = source.theta_c.value_or(std::nan(""));
  add_of_rows(list, theta_c);
  add_of_frames(list, theta_c);
  if (source.theta_c)
    list.add("theta_c", "θ_c", "the slope fails", *source.theta_c, TimelineEvent::Kind::failure);
  add_rearrangements(list);
  for (std::size_t k = 0; k < source.commands.size(); ++k) list.add_command(k);
  std::ranges::stable_sort(list.events, {}, &TimelineEvent::place);
  return std::move(list.events);
}

}  // namespace talus::view
