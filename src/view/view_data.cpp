#include "view/view_data.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <utility>

#include "core/errors.h"
#include "core/trigonometry.h"
#include "pictures/frame_choice.h"
#include "runs/event_catalogue.h"
#include "session/command.h"

namespace talus {

void ViewModel::Data::open_replay() {
  frames = std::make_shared<RunFrames>(pictures.path, turn);
  replay.emplace(frames);
  const RunFile& file = frames->file();
  pictures.run = file.header();
  pictures.has_program = file.has_program();
  all_statics = statics();
  theta_c = find_value(file.checkpoint().results, "theta_c");
  if (theta_c && !std::isfinite(*theta_c)) theta_c.reset();  // it has not failed
  analysis = read_usable_analysis(pictures.path, file);
  rows = file.observables();
  plot_rows();
  plot_steps(file.steps(), plots);
  commands = file.commands();
  if (const World& end = file.checkpoint().world; !commands.empty())
    file_rows = rows_up_to(file.all_observables(), end.step, end.time, end.tilt);
  open_bookmarks();
  // The bed is highest at its beginning or at its end.
  bed = bed_extent(statics());
  extend(bed, {*frames->read(replay->count() - 1), statics()});
  show(replay->frame(0));
  begin_series();
  find_events();
}

void ViewModel::Data::begin_series() {
  end_series();
  if (replay) {
    const auto read_frame = [from = frames](std::size_t k) { return from->read(k); };
    series = std::make_unique<FrameSeries>(all_statics, read_frame);
    ahead = std::make_unique<FrameAhead>(all_statics, read_frame);
    series->set_counts(replay->count(), frames->file().frame_count());
  } else {
    series = std::make_unique<FrameSeries>(all_statics,
                                           [from = recorded](std::size_t k) { return from->read(k); });
    series->set_counts(recorded->all().size(), recorded->all().size());
  }
}

void ViewModel::Data::end_series() {
  history.reset();
  series.reset();
  ahead.reset();
}

void ViewModel::Data::start_live(const std::string& next_output, bool overwrite) {
  auto next =
      std::make_unique<LiveRun>(scenario, scenario_text, next_output, overwrite, command_line, branch);
  output = next_output;
  end_series();
  pictures.met = {};
  pictures.has_program = !scenario.tilt.program.empty();
  live = std::move(next);
  pictures.run.statics = all_statics = live->statics();
  pictures.run.seed = scenario.seed;
  theta_c.reset();
  rows.clear();
  std::vector<Plot> kept = empty_plots();
  for (const Plot& plot : plots)
    if (plot.added) kept.push_back(plot_of_quantity(*plot.series[0].quantity));
  plots = std::move(kept);
  if (axis == PlotAxis::angle_left) axis = PlotAxis::tilt;
  name_axis(axis, plots);
  newest = live->frame();
  held.reset();
  ended = false;
  events.clear();
  commands.clear();
  bookmarks.clear();
  bookmarks_unread.clear();
  dilation.reset();
  first_frame.reset();
  show(newest);
  take_all_recorded();
}

void ViewModel::Data::plot_rows() { plot_observables(rows, statics(), abscissa(), plots); }

void ViewModel::Data::plot_values() {
  plot_frames(series->values(), frame_times(), statics().mean_diameter, abscissa(), plots);
  if (analysis) plot_stored(analysis->frames, frame_times(), statics().mean_diameter, abscissa(), plots);
  plot_ghost(ghost ? &*ghost : nullptr, axis, series->rule().threshold_factor, plots);
}

void ViewModel::Data::note_thresholds(const OverloadRule& rule) {
  note_threshold(rule.threshold_factor, theta_c ? std::nullopt : std::optional(rule.theta_c), plots);
}

std::shared_ptr<const Frame> ViewModel::Data::read(std::size_t k) {
  try {
    return replay->frame(k);
  } catch (const Error& failure) {
    error = failure.what();
    return nullptr;
  }
}

void ViewModel::Data::show_replayed() {
  const std::size_t k = replay->index();
  if (auto made = ahead->take(k, l_min)) {
    replay->keep(k, made->stored);
    show(std::move(made->stored), std::move(made->mapped));
  } else if (auto next = read(k)) {
    show(std::move(next));
  } else {
    return replay->play(false);
  }
  // On by as many frames as last time, back as well.
  const std::size_t following = k == shown_before ? k + 1 : k + (k - shown_before);
  shown_before = k;
  if (following < replay->count()) ahead->begin(following, l_min, replay->kept(following));
}

/// Whether grains are above the bed that they will make.
bool ViewModel::Data::is_falling() const {
  const DepositionMethod method = scenario.deposition.method;
  return live->status().depositing &&
         (method == DepositionMethod::pour || method == DepositionMethod::collapse);
}

/// What has been recorded, with room for the bed that is being deposited: grains fall into the picture from
/// above, so that it and all around it stay where they are.
MapExtent ViewModel::Data::live_extent() const {
  constexpr double surplus = 1.05;  // of the depth: what a loose bed and its surface have
  MapExtent extent = series ? series->extent() : bed_extent(statics());
  const RunStatics& of = statics();
  extent.y_max = std::max({extent.y_max, surplus * of.depth, of.depth + of.mean_diameter});
  return extent;
}

void ViewModel::Data::show(std::shared_ptr<const Frame> next, std::shared_ptr<const Frame> mapped) {
  if (next == stored) return;
  stored = std::move(next);
  if (stored->x.size() != statics().radius.size())
    pictures.run.statics = arrived_statics(all_statics, stored->grain_count());
  if (live) bed = live_extent();
  extend(bed, {*stored, statics()});
  if (live && is_falling()) bed.y_max = live_extent().y_max;
  make_frame(std::move(mapped));
}

bool ViewModel::Data::read_with(double next_l_min) {
  if (next_l_min == l_min) return false;
  l_min = next_l_min;
  make_frame();
  return true;
}

void ViewModel::Data::make_frame(std::shared_ptr<const Frame> mapped) {
  frame = mapped ? std::move(mapped) : std::make_shared<const Frame>(mapped_frame(*stored, statics(), l_min));
  plot_gamma({*frame, statics()}, plots);
}

bool ViewModel::Data::take_live() {
  auto next = live->frame();
  const LiveStatus status = live->status();
  theta_c = status.theta_c;
  if (next == newest) return false;
  newest = std::move(next);
  const std::size_t before = recorded->all().size();
  recorded->add(live->recorded_frames(before));
  series->set_counts(recorded->all().size(), recorded->all().size());
  const std::vector<ObservableRow> more = live->observables(rows.size());
  rows.insert(rows.end(), more.begin(), more.end());
  if (!more.empty()) plot_rows();
  plot_steps(live->steps(0), plots);
  const std::size_t commands_before = std::exchange(commands, live->commands()).size();
  if (recorded->all().size() != before || commands.size() != commands_before || !status.running)
    find_events();
  if (!held) show(newest);
  return true;
}

void ViewModel::Data::hold_at(std::optional<std::size_t> frame_held) {
  if (!live || recorded->all().empty()) frame_held.reset();
  held = frame_held;
  if (held) held = std::min(*held, recorded->all().size() - 1);
  show(held ? recorded->all()[*held] : newest);
}

std::string ViewModel::Data::take_end() {
  if (!live || ended) return {};
  const LiveStatus status = live->status();
  if (!status.theta_c && !status.done) return {};
  ended = true;
  if (status.theta_c) return fmt::format("The slope failed at {:.2f}°.", degrees(*status.theta_c));
  return fmt::format("The run ended at {:.2f}°; the slope has not failed.", degrees(status.tilt));
}

void ViewModel::Data::find_events() {
  TimelineSource source;
  source.tilts = frame_tilts();
  source.times = frame_times();
  source.rows = rows;
  source.values = series->values();
  const std::vector<Command> given = given_commands(commands);
  source.commands = given;
  const std::vector<ObservableRow> live_rows =
      live && !given.empty() ? rows_up_to(rows, newest->step, newest->time, newest->tilt)
                             : std::vector<ObservableRow>();
  source.command_rows = live ? live_rows : file_rows;
  if (analysis) source.rearrangements = analysis->events;
  source.bookmarks = bookmarks;
  source.all_times = all_frame_times();
  source.energy_unit = mean_grain_mass(all_statics) * all_statics.gravity * all_statics.mean_diameter;
  source.theta_c = theta_c;
  source.mean_diameter = statics().mean_diameter;
  source.cut = length_cut(statics(), series->rule().l_min);
  source.may_change = live && !live->status().done;
  events = timeline_events(source);
  dilation = dilation_frame(rows, source.tilts, theta_c.value_or(std::nan("")));
}

bool ViewModel::Data::follow_frames(const OverloadRule& rule) {
  bool changed = !(series->rule() == rule);
  if (changed) {
    const auto threshold = analysis ? find_threshold(*analysis, rule) : std::nullopt;
    series->begin(rule, threshold ? stored_records(*analysis, *threshold) : std::vector<FrameRecord>{});
  }
  if (series->take_in(pictures)) {
    if (replay) extend(bed, series->extent());
    if (!series->error().empty()) error = series->error();
    changed = true;
  }
  if (changed) {
    plot_values();
    note_thresholds(rule);
    find_events();
  }
  return changed;
}

std::size_t ViewModel::Data::frame_count() const { return replay ? replay->count() : recorded->all().size(); }

std::optional<std::size_t> ViewModel::Data::place_of(Landmark landmark) const {
  const std::vector<double> tilts = frame_tilts();
  if (tilts.empty()) return std::nullopt;
  switch (landmark) {
    case Landmark::first:
      return 0;
    case Landmark::last:
      return frame_count() - 1;
    case Landmark::theta_c:
      if (!theta_c || std::abs(tilts.front()) > *theta_c) return std::nullopt;
      return frame_at_repose(tilts, *theta_c);
    case Landmark::percolation:
      return percolation_frame(series->values());
    case Landmark::theta_d:
      return dilation;
    case Landmark::length_jump:
      if (!series->has_all_values() || (live && !live->status().done)) return std::nullopt;
      return length_jump_frame(series->values(), length_cut(statics(), series->rule().l_min),
                               theta_c.value_or(std::nan("")));
  }
  return std::nullopt;
}

}  // namespace talus
