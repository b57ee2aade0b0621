/// The run shown: opening, replaying, computing, branching, and following it.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <functional>
#include <utility>

#include "base/errors.h"
#include "base/hash.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "pictures/frame_choice.h"
#include "runs/event_catalogue.h"
#include "session/frame_state.h"
#include "session/run_header.h"
#include "session/run_identity.h"
#include "view/camera.h"
#include "view/view_model.h"

namespace talus::view {
namespace {

/// Returns "slope-2.h5" after "slope.h5", or "slope-branch-1.h5": the first name, counting from `number`,
/// that does not exist yet.
std::string next_output(const std::string& run, const char* what, int number, const std::string& extension) {
  const std::filesystem::path path(run);
  for (int k = number;; ++k) {
    const std::string name = fmt::format("{}-{}{}{}", path.stem().string(), what, k, extension);
    std::string next = (path.parent_path() / name).string();
    if (io::run_presence(next) == io::RunPresence::none) return next;
  }
}

/// Returns the path in which a recorded run is continued; empty if it is not recorded.
std::string output_after(const std::string& output, const std::string& first) {
  return output.empty() ? "" : next_output(first, "", 2, std::filesystem::path(first).extension().string());
}

}  // namespace

ViewModel ViewModel::open(const std::string& path, const std::vector<std::string>& settings,
                          const std::string& output, bool overwrite, const std::string& command_line) {
  ViewModel model;
  model.pictures_.path = path;
  if (io::is_run(path)) {
    if (!settings.empty() || !output.empty() || overwrite)
      throw Error(ExitCode::usage,
                  path + " is a run, which can only be replayed: leave out the settings and the output");
    model.open_replay();
  } else {
    model.scenario_ = scenario::read_scenario(path, settings, &model.scenario_text_);
    model.scenario_settings_ = settings;
    model.command_line_ = command_line;
    model.first_output_ = output;
    model.start_live(output, overwrite);
  }
  const pictures::MapExtent& bed = model.bed_;
  model.state.map.layers = {pictures::MapKind::gamma};
  model.state.camera = {0.5 * (bed.x_min + bed.x_max), 0.5 * (bed.y_min + bed.y_max), 1.0};
  return model;
}

void ViewModel::open_replay() {
  frames_ = run_file_ = std::make_shared<RunFrames>(pictures_.path);
  replay_.emplace(run_file_);
  const io::RunFile& file = run_file_->file();
  pictures_.run = file.header();
  pictures_.goes_by_time = file.goes_by_time();
  all_statics_ = statics();
  theta_c_ = find_value(file.checkpoint().results, "theta_c");
  if (theta_c_ && !std::isfinite(*theta_c_)) theta_c_.reset();  // the run has not failed
  analysis_ = read_usable_analysis(file);
  rows_ = file.observables();
  plot_rows();
  plot_steps(file.steps(), plots_);
  commands_ = file.commands();
  if (const World& end = file.checkpoint().world; !commands_.empty())
    file_rows_ = session::rows_up_to(file.all_observables(), end.step, end.time, end.tilt);
  // The bed is highest at its beginning or at its end.
  bed_ = pictures::bed_extent(statics());
  pictures::extend(bed_, {*frames_->read(frame_count() - 1), statics()});
  show(frames_->frame(0));
  begin_series();
  find_events();
}

void ViewModel::begin_series() {
  end_series();
  const ReadFrame read_frame = [from = frames_](std::size_t k) { return from->read(k); };
  series_ = std::make_unique<FrameSeries>(all_statics_, read_frame);
  if (replay_) ahead_ = std::make_unique<FrameAhead>(all_statics_, read_frame);
  series_->set_counts(frame_count(), frames_->instants().tilt_count);
}

void ViewModel::end_series() {
  history_.reset();
  series_.reset();
  ahead_.reset();
}

void ViewModel::start_live(const std::string& next_output, bool overwrite) {
  auto next =
      std::make_unique<LiveRun>(scenario_, scenario_text_, next_output, overwrite, command_line_, origin_);
  output_ = next_output;
  end_series();
  pictures_.seen_frames = {};
  pictures_.goes_by_time = !scenario_.tilt.program.empty();
  live_ = std::move(next);
  pictures_.run.statics = all_statics_ = live_->statics();
  pictures_.run.seed = scenario_.seed;
  state.seed = static_cast<std::int64_t>(scenario_.seed);  // at most 2^63 - 1
  theta_c_.reset();
  rows_.clear();
  std::vector<Plot> kept = empty_plots();
  for (const Plot& plot : plots_)
    if (plot.added) kept.push_back(plot_of_quantity(*plot.series[0].quantity));
  plots_ = std::move(kept);
  if (axis_ == PlotAxis::angle_left) axis_ = PlotAxis::tilt;
  name_axis(axis_, plots_);
  newest_ = live_->frame();
  held_.reset();
  ended_ = false;
  events_.clear();
  commands_.clear();
  show(newest_);
  take_all_recorded();
}

std::shared_ptr<const Frame> ViewModel::frame_at(std::size_t k) {
  try {
    return frames_->frame(k);
  } catch (const Error& failure) {
    error_ = failure.what();
    return nullptr;
  }
}

void ViewModel::show_replayed() {
  const std::size_t k = replay_->index();
  if (auto made = ahead_->take(k, l_min_)) {
    run_file_->keep(k, made->stored);
    show(std::move(made->stored), std::move(made->mapped));
  } else if (auto next = frame_at(k)) {
    show(std::move(next));
  } else {
    return replay_->play(false);
  }
  // Predict the same stride as the last one, also backwards.
  const std::size_t following = k == shown_before_ ? k + 1 : k + (k - shown_before_);
  shown_before_ = k;
  if (following < frame_count()) ahead_->begin(following, l_min_, run_file_->kept(following));
}

/// Returns whether grains are above the bed that they will form.
bool ViewModel::is_falling() const {
  const scenario::DepositionMethod method = scenario_.deposition.method;
  return live_->status().depositing &&
         (method == scenario::DepositionMethod::pour || method == scenario::DepositionMethod::collapse);
}

/// Returns the extent recorded so far, with room for the bed that is being deposited: grains enter the
/// picture from above, while everything else stays in place.
pictures::MapExtent ViewModel::live_extent() const {
  constexpr double surplus = 1.05;  // relative to the depth, for a loose bed and its surface
  pictures::MapExtent extent = series_ ? series_->extent() : pictures::bed_extent(statics());
  const RunStatics& bed_statics = statics();
  extent.y_max =
      std::max({extent.y_max, surplus * bed_statics.depth, bed_statics.depth + bed_statics.mean_diameter});
  return extent;
}

void ViewModel::show(std::shared_ptr<const Frame> next, std::shared_ptr<const Frame> mapped) {
  if (next == stored_) return;
  stored_ = std::move(next);
  if (stored_->x.size() != statics().radius.size())
    pictures_.run.statics = arrived_statics(all_statics_, stored_->grain_count());
  if (live_) bed_ = live_extent();
  pictures::extend(bed_, {*stored_, statics()});
  if (live_ && is_falling()) bed_.y_max = live_extent().y_max;
  make_frame(std::move(mapped));
}

void ViewModel::make_frame(std::shared_ptr<const Frame> mapped) {
  frame_ = mapped ? std::move(mapped)
                  : std::make_shared<const Frame>(pictures::mapped_frame(*stored_, statics(), l_min_));
  plot_gamma(bed(), plots_);
}

bool ViewModel::poll_live_run() {
  auto next = live_->frame();
  const LiveStatus status = live_->status();
  theta_c_ = status.theta_c;
  if (next == newest_) return false;
  newest_ = std::move(next);
  const std::size_t before = frame_count();
  recorded_->add(live_->recorded_frames(before));
  series_->set_counts(frame_count(), frame_count());
  if (frame_count() != before && !theta_c_ &&
      std::ranges::adjacent_find(frame_tilts(), std::greater_equal()) != frame_tilts().end())
    pictures_.goes_by_time = true;  // a command holds or turns the tilt
  const std::vector<ObservableRow> more = live_->observables(rows_.size());
  rows_.insert(rows_.end(), more.begin(), more.end());
  if (!more.empty()) plot_rows();
  plot_steps(live_->steps(0), plots_);
  const std::size_t commands_before = std::exchange(commands_, live_->commands()).size();
  if (frame_count() != before || commands_.size() != commands_before || !status.running) find_events();
  if (!held_) show(newest_);
  return true;
}

void ViewModel::hold_at(std::optional<std::size_t> frame_held) {
  if (frame_count() == 0) frame_held.reset();
  held_ = frame_held;
  if (held_) held_ = std::min(*held_, frame_count() - 1);
  show(held_ ? frames_->frame(*held_) : newest_);
}

std::string ViewModel::take_end() {
  if (!live_ || ended_) return {};
  const LiveStatus status = live_->status();
  if (!status.theta_c && !status.done) return {};
  ended_ = true;
  if (status.theta_c) return fmt::format("The slope failed at {:.2f}°.", degrees(*status.theta_c));
  return fmt::format("The run ended at {}°; the slope has not failed.", degrees_text(status.tilt, 2));
}

bool ViewModel::follow_frames(const pictures::OverloadRule& rule) {
  bool changed = !(series_->rule() == rule);
  if (changed) {
    const auto threshold = analysis_ ? find_threshold(*analysis_, rule) : std::nullopt;
    series_->begin(rule,
                   threshold ? stored_records(*analysis_, *threshold) : std::vector<analysis::FrameRecord>{});
  }
  if (series_->collect_ready(pictures_)) {
    if (replay_) pictures::extend(bed_, series_->extent());
    if (!series_->error().empty()) error_ = series_->error();
    changed = true;
  }
  if (changed) {
    plot_values();
    note_thresholds(rule);
    find_events();
  }
  return changed;
}

void ViewModel::take_all_recorded() {
  series_.reset();
  frames_ = recorded_ = std::make_shared<RecordedFrames>();
  recorded_->add(live_->recorded_frames(0));
  rows_ = live_->observables(0);
  commands_ = live_->commands();
  theta_c_ = live_->status().theta_c;
  plot_rows();
  begin_series();
  find_events();
}

/// The file is read up to here, and not again while the branch is computed.
void ViewModel::branch() {
  if (is_live()) return;
  const std::size_t k = frame_index();
  end_series();
  const io::RunFile& run = run_file_->file();
  io::BranchOrigin origin;
  scenario::Scenario of_run;
  try {
    of_run = runs::stored_scenario(run.header(), pictures_.path + ":/parameters");
    origin = {pictures_.path, static_cast<std::int64_t>(k), hash_text(state_hash(run.checkpoint().world)),
              session::checkpoint_at_frame(run, k),
              session::history_text(session::departures(run, of_run, run.instant(k).step))};
  } catch (const Error&) {
    begin_series();
    throw;
  }
  scenario_text_ = run.header().scenario_given;
  if (session::Session start(of_run, origin.start); start.adopt_friction()) {
    of_run = start.scenario();
    origin.start = session::start_of(start.checkpoint(0.0));
    scenario_text_ = scenario::resolved_toml(of_run);
  }
  origin_ = std::move(origin);
  scenario_ = std::move(of_run);
  command_line_ = fmt::format("talus view {}", pictures_.path);
  parent_tilts_ = run.all_frame_tilts();
  parent_theta_c_ = theta_c_;
  replay_.reset();
  run_file_.reset();
  frames_ = std::make_shared<RecordedFrames>();
  analysis_.reset();
  first_output_.clear();
  start_live("", false);
  state.run_path = next_output(path(), "branch-", 1, ".h5");
  state.announcement.clear();
}

std::optional<BranchLine> ViewModel::branch_line() const {
  if (!origin_) return std::nullopt;
  return BranchLine{origin_->run, static_cast<std::size_t>(origin_->frame), parent_tilts_};
}

void ViewModel::back() {
  if (!is_live()) return;
  const std::string next = output_after(output_, first_output_);
  follow();
  end_series();
  try {
    live_->back(next);
  } catch (const Error&) {
    begin_series();
    throw;
  }
  output_ = next;
  ended_ = false;
  state.announcement.clear();
  newest_ = live_->frame();
  take_all_recorded();
  show(newest_);
}

std::size_t ViewModel::frame_index() const {
  if (replay_) return replay_->index();
  return static_cast<std::size_t>(std::ranges::lower_bound(frames_->instants().times, frame_->time) -
                                  frames_->instants().times.begin());
}

std::vector<double> ViewModel::tilts_of_tilt() const {
  std::vector<double> tilts = frames_->instants().tilts;
  tilts.resize(frames_->instants().tilt_count);
  return tilts;
}

std::vector<double> ViewModel::times_of_tilt() const {
  std::vector<double> times = frames_->instants().times;
  times.resize(frames_->instants().tilt_count);
  return times;
}

std::size_t ViewModel::frame_at_angle(const std::string& angle) const {
  if (!replay_)
    throw Error(ExitCode::usage, path() + ": this run is being computed, so it has no frames to go to");
  return pictures::frames_at(tilts_of_tilt(), {angle}, theta_c_.value_or(not_known)).front();
}

void ViewModel::restart(std::uint64_t seed) {
  if (!is_live()) return;
  live_->halt();
  if (!origin_) scenario_.seed = seed;
  start_live(output_after(output_, first_output_), false);
  select(std::optional<Index>());
  state.announcement.clear();
}

void ViewModel::record(const std::string& output) {
  if (!is_live()) return;
  live_->record(output, false);
  output_ = first_output_ = output;
  state.discard_asked = false;
}

bool ViewModel::may_discard() {
  const std::int64_t first = origin_ ? origin_->start.world.step : 0;
  const bool saved = !is_live() || !output_.empty() || (live_->status().step == first && commands_.empty());
  if (saved || std::exchange(state.discard_asked, false)) return true;
  state.discard_asked = true;
  state.message = "This run is not saved. Press again to discard it, or s to save it.";
  return false;
}

void ViewModel::hold() {
  if (is_live())
    live_->halt();
  else
    begin_series();
}

Recording ViewModel::recording() const {
  return {origin_ ? "" : pictures_.path, scenario_settings_, output_, pictures_.run.seed};
}

void ViewModel::follow() {
  if (held_) hold_at(std::nullopt);
}

void ViewModel::go_to(std::size_t frame) {
  if (!replay_) return hold_at(frame);
  replay_->go_to(frame);
  show_replayed();
}

void ViewModel::go_to(Landmark landmark) {
  if (is_live() && landmark == Landmark::last) return follow();
  if (const auto frame = place_of(landmark)) go_to(*frame);
}

void ViewModel::play(bool on) {
  if (!replay_) return;
  replay_->play(on);
  show_replayed();
}

void ViewModel::set_speed(double degrees_per_second) {
  if (replay_) replay_->set_speed(degrees_per_second);
}

bool ViewModel::update(double seconds) {
  if (live_) live_->set_pace(live_paces[state.pace]);
  bool changed = live_ && poll_live_run();
  if (replay_ && replay_->advance(seconds)) {
    show_replayed();
    changed = true;
  }
  if (const double l_min = std::clamp(state.map.l_min, 0.0, 100.0); l_min != l_min_) {
    l_min_ = l_min;
    make_frame();
    changed = true;
  }
  changed = follow_frames(first().settings()) || changed;
  changed = follow_history() || changed;
  follow_grain();
  state.camera = centred(clamped(state.camera, bed_, mean_diameter()), first().part(aspect_));
  if (const std::string end = take_end(); !end.empty()) state.announcement = end;
  if (!error_.empty()) state.message = std::exchange(error_, {});
  return changed;
}

}  // namespace talus::view
