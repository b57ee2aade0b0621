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
#include "view/view_model.h"
#include "view/view_state.h"

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
  model.recording_ = {path, settings, "", 0};
  if (io::is_run(path)) {
    if (!settings.empty() || !output.empty() || overwrite)
      throw Error(ExitCode::usage,
                  path + " is a run, which can only be replayed: leave out the settings and the output");
    model.open_replay();
  } else {
    model.scenario_ = scenario::read_scenario(path, settings, &model.scenario_text_);
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
  frames_ = replay_ = std::make_shared<Replay>(pictures_.path);
  const io::RunFile& file = replay_->file();
  pictures_.run = file.header();
  recording_.seed = pictures_.run.seed;
  pictures_.goes_by_time = file.goes_by_time();
  all_statics_ = statics();
  theta_c_ = find_value(file.checkpoint().results, "theta_c");
  if (theta_c_ && !std::isfinite(*theta_c_)) theta_c_.reset();  // the run has not failed
  analysis_ = read_usable_analysis(file);
  own_maps_ = pictures::stored_maps(file);
  rows_ = file.observables();
  steps_ = file.steps();
  plot_rows();
  commands_ = file.commands();
  if (const World& end = file.checkpoint().world; !commands_.empty())
    command_rows_ = session::rows_up_to(file.all_observables(), end.step, end.time, end.tilt);
  // The bed is highest at its beginning or at its end.
  bed_ = pictures::bed_extent(statics());
  pictures::extend(bed_, {*frames_->read(frame_count() - 1), statics()});
  show(frames_->frame(0));
  begin_reading();
  find_events();
}

void ViewModel::begin_reading() {
  reader_.reset();  // ends before the next one reads the same file
  reader_ = std::make_unique<FrameReader>(all_statics_, frames_);
  reader_->set_counts(frame_count(), frames_->instants().tilt_count);
}

void ViewModel::start_live(const std::string& next_output, bool overwrite) {
  auto next =
      std::make_shared<LiveRun>(scenario_, scenario_text_, next_output, overwrite, command_line_, origin_);
  reader_.reset();
  replay_.reset();
  analysis_.reset();
  recording_.output = next_output;
  recording_.seed = scenario_.seed;
  pictures_.seen_frames = {};
  own_maps_.clear();
  state.map.own.reset();
  pictures_.goes_by_time = !scenario_.tilt.program.empty();
  frames_ = live_ = std::move(next);
  pictures_.run.statics = all_statics_ = live_->statics();
  pictures_.run.seed = scenario_.seed;
  state.seed = static_cast<std::int64_t>(scenario_.seed);  // at most 2^63 - 1
  std::vector<Plot> kept = empty_plots();
  for (const Plot& plot : plots_)
    if (plot.added) kept.push_back(plot_of_quantity(*plot.series[0].quantity));
  plots_ = std::move(kept);
  if (axis_ == PlotAxis::angle_left) axis_ = PlotAxis::tilt;
  name_axis(axis_, plots_);
  held_ = ended_ = false;
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
  auto mapped = reader_->take(k, l_min_);
  auto next = frame_at(k);
  if (!next) return replay_->play(false);
  show(std::move(next), std::move(mapped));
  // Predict the same stride as the last one, also backwards.
  const std::size_t following = k == shown_before_ ? k + 1 : k + (k - shown_before_);
  shown_before_ = k;
  if (following < frame_count()) reader_->prepare(following, l_min_);
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
  pictures::MapExtent extent = reader_->extent();
  extent.y_max = std::max({extent.y_max, surplus * statics().depth, statics().depth + mean_diameter()});
  return extent;
}

void ViewModel::show(std::shared_ptr<const Frame> next, std::shared_ptr<const Frame> mapped) {
  if (next == stored_) return;
  stored_ = std::move(next);
  if (stored_->x.size() != statics().radius.size())
    pictures_.run.statics = arrived_statics(all_statics_, stored_->grain_count());
  if (live_) bed_ = live_extent();
  const double top = bed_.y_max;
  pictures::extend(bed_, {*stored_, statics()});
  if (live_ && is_falling()) bed_.y_max = top;
  make_frame(std::move(mapped));
}

void ViewModel::make_frame(std::shared_ptr<const Frame> mapped) {
  frame_ = mapped ? std::move(mapped)
                  : std::make_shared<const Frame>(pictures::mapped_frame(*stored_, statics(), l_min_));
  plot_gamma(bed(), plots_);
}

bool ViewModel::poll_live_run() {
  auto next = live_->newest();
  const LiveStatus status = live_->status();
  theta_c_ = status.theta_c;
  if (next == newest_) return false;
  newest_ = std::move(next);
  const std::size_t before = frame_count();
  live_->take_frames();
  reader_->set_counts(frame_count(), frame_count());
  if (frame_count() != before && !theta_c_ &&
      std::ranges::adjacent_find(frame_tilts(), std::greater_equal()) != frame_tilts().end())
    pictures_.goes_by_time = true;  // a command holds or turns the tilt
  const std::vector<ObservableRow> more = live_->observables(rows_.size());
  rows_.insert(rows_.end(), more.begin(), more.end());
  if (!more.empty()) plot_rows();
  const std::size_t commands_before = std::exchange(commands_, live_->commands()).size();
  if (frame_count() != before || commands_.size() != commands_before || !status.running) find_events();
  if (!held_) show(newest_);
  return true;
}

std::string ViewModel::take_end() {
  if (!live_ || ended_) return {};
  const LiveStatus status = live_->status();
  if (!status.theta_c && !status.done) return {};
  ended_ = true;
  if (status.theta_c) return fmt::format("The slope failed at {:.2f}°.", degrees(*status.theta_c));
  return fmt::format("The run ended at {}°; the slope has not failed.", degrees_text(status.tilt, 2));
}

bool ViewModel::follow_reader(const pictures::OverloadRule& rule) {
  reader_->follow(frame_count() > 0 ? state.selecting.selection.contact : std::nullopt);
  bool changed = !(reader_->rule() == rule);
  if (changed) {
    const auto threshold = analysis_ ? find_threshold(*analysis_, rule) : std::nullopt;
    reader_->evaluate(
        rule, threshold ? stored_records(*analysis_, *threshold) : std::vector<analysis::FrameRecord>{});
  }
  if (reader_->collect_values(pictures_)) {
    if (replay_) pictures::extend(bed_, reader_->extent());
    if (!reader_->error().empty()) error_ = reader_->error();
    changed = true;
  }
  if (changed) {
    plot_values();
    find_events();
  }
  return reader_->collect_history() || changed;
}

void ViewModel::take_all_recorded() {
  newest_ = live_->newest();
  rows_ = live_->observables(0);
  commands_ = live_->commands();
  theta_c_ = live_->status().theta_c;
  plot_rows();
  begin_reading();
  find_events();
  show(newest_);
}

/// The file is read up to here, and not again while the branch is computed.
void ViewModel::branch() {
  if (is_live()) return;
  const std::size_t k = frame_index();
  reader_.reset();
  const io::RunFile& run = replay_->file();
  parent_theta_c_ = theta_c_;
  command_line_ = fmt::format("talus view {}", pictures_.path);
  first_output_.clear();
  try {
    scenario_ = runs::stored_scenario(run.header(), pictures_.path + ":/parameters");
    origin_ =
        io::BranchOrigin{pictures_.path, static_cast<std::int64_t>(k),
                         hash_text(state_hash(run.checkpoint().world)), session::checkpoint_at_frame(run, k),
                         session::history_text(session::departures(run, scenario_, run.instant(k).step))};
    scenario_text_ = run.header().scenario_given;
    if (session::Session start(scenario_, origin_->start); start.adopt_friction()) {
      scenario_ = start.scenario();
      origin_->start = session::start_of(start.checkpoint(0.0));
      scenario_text_ = scenario::resolved_toml(scenario_);
    }
    start_live("", false);
  } catch (const Error&) {
    origin_.reset();
    begin_reading();
    throw;
  }
  recording_.scenario.clear();
  state.run_path = next_output(path(), "branch-", 1, ".h5");
  state.announcement.clear();
}

void ViewModel::back() {
  if (!is_live()) return;
  const std::string next = output_after(recording_.output, first_output_);
  follow();
  reader_.reset();
  try {
    live_->back(next);
  } catch (const Error&) {
    begin_reading();
    throw;
  }
  recording_.output = next;
  ended_ = false;
  state.announcement.clear();
  take_all_recorded();
}

SolvedSteps ViewModel::solved_steps() const {
  if (live_) return live_->status().solved;
  const auto value = [](StepField field) { return [field](const StepRow& row) { return at(row, field); }; };
  SolvedSteps solved{std::ssize(steps_), std::ranges::count(steps_, 0.0, value(StepField::converged)), {}};
  const auto step = static_cast<double>(frame().step);
  const auto after = std::ranges::upper_bound(steps_, step, {}, value(StepField::step));
  if (after != steps_.begin()) solved.last = *(after - 1);
  return solved;
}

std::size_t ViewModel::frame_index() const {
  if (replay_) return replay_->index();
  return static_cast<std::size_t>(std::ranges::lower_bound(frames_->instants().times, frame_->time) -
                                  frames_->instants().times.begin());
}

std::size_t ViewModel::frame_at_angle(const std::string& angle) const {
  if (!replay_)
    throw Error(ExitCode::usage, path() + ": this run is being computed, so it has no frames to go to");
  return pictures::single_frame(
      pictures::frames_at(tilts_of_tilt(), {angle}, theta_c_.value_or(not_known), frame_count()), angle);
}

void ViewModel::restart(std::uint64_t seed) {
  if (!is_live()) return;
  live_->halt();
  if (!origin_) scenario_.seed = seed;
  start_live(output_after(recording_.output, first_output_), false);
  state.drag.reset();
  select(std::optional<Index>());
  state.announcement.clear();
}

void ViewModel::record(const std::string& output) {
  if (!is_live()) return;
  live_->record(output);
  recording_.output = first_output_ = output;
  state.discard_asked = false;
}

bool ViewModel::may_discard() {
  const std::int64_t first = origin_ ? origin_->start.world.step : 0;
  const bool saved =
      !is_live() || !recording_.output.empty() || (live_->status().step == first && commands_.empty());
  if (saved || std::exchange(state.discard_asked, false)) return true;
  state.discard_asked = true;
  state.message = "This run is not saved. Press again to discard it, or s to save it.";
  return false;
}

void ViewModel::hold() {
  if (is_live())
    live_->halt();
  else
    begin_reading();
}

void ViewModel::follow() {
  if (std::exchange(held_, false)) show(newest_);
}

void ViewModel::go_to(std::size_t frame) {
  if (replay_) {
    replay_->go_to(frame);
    return show_replayed();
  }
  held_ = frame_count() > 0;
  if (held_) show(frames_->frame(std::min(frame, frame_count() - 1)));
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
  changed = follow_reader(first().settings()) || changed;
  if (state.selecting.follow && state.selected && *state.selected < frame().grain_count()) {
    state.camera.centre_x = frame().x[*state.selected];
    state.camera.centre_y = frame().y[*state.selected];
  }
  state.camera = centred(clamped(state.camera, bed_, mean_diameter()), first().part(aspect_));
  if (const std::string end = take_end(); !end.empty()) state.announcement = end;
  if (!error_.empty()) state.message = std::exchange(error_, {});
  return changed;
}

}  // namespace talus::view
