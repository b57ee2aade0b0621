#include "view/view_model.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>

#include "analysis/last_rise.h"
#include "core/errors.h"
#include "core/trigonometry.h"
#include "io/run_file.h"
#include "pictures/frame_choice.h"
#include "view/camera.h"
#include "view/next_output.h"
#include "view/view_data.h"

namespace talus {
std::string next_output(const std::string& first) {
  const std::filesystem::path path(first);
  for (int k = 2;; ++k) {
    const std::string name = fmt::format("{}-{}{}", path.stem().string(), k, path.extension().string());
    std::string next = (path.parent_path() / name).string();
    if (run_presence(next) == RunPresence::none) return next;
  }
}

ViewModel ViewModel::open(const std::string& path, const std::vector<std::string>& settings,
                          const std::string& output, bool overwrite, const std::string& command_line) {
  auto data = std::make_unique<Data>();
  data->pictures.path = path;
  if (is_run(path)) {
    if (!settings.empty() || !output.empty() || overwrite)
      throw Error(ExitCode::usage,
                  path + " is a run, which is only replayed: leave out the settings and the output");
    data->open_replay();
  } else {
    data->scenario = read_scenario(path, settings, &data->scenario_text);
    data->scenario_settings = settings;
    data->command_line = command_line;
    data->first_output = output;
    data->start_live(output, overwrite);
  }
  ViewModel model(std::move(data));
  const MapExtent& bed = model.data_->bed;
  model.state.map.layers = {MapKind::gamma};
  model.state.camera = {0.5 * (bed.x_min + bed.x_max), 0.5 * (bed.y_min + bed.y_max), 1.0};
  return model;
}

ViewModel::ViewModel(std::unique_ptr<Data> data) : data_(std::move(data)) {}
ViewModel::ViewModel(ViewModel&&) noexcept = default;
ViewModel& ViewModel::operator=(ViewModel&&) noexcept = default;
ViewModel::~ViewModel() = default;

bool ViewModel::is_live() const { return !data_->replay; }
const std::string& ViewModel::path() const { return data_->pictures.path; }
LiveRun* ViewModel::live() { return data_->live.get(); }
std::uint64_t ViewModel::seed() const { return data_->pictures.run.seed; }

void ViewModel::restart(std::uint64_t seed) {
  if (!is_live()) return;
  data_->live->halt();
  if (!data_->branch) data_->scenario.seed = seed;
  data_->start_live(data_->output.empty() ? "" : next_output(data_->first_output), false);
  select(std::optional<Index>());
  state.announcement.clear();
}

void ViewModel::record(const std::string& output) {
  if (!is_live()) return;
  data_->live->record(output, false);
  data_->output = data_->first_output = output;
  state.discard_asked = false;
}

bool ViewModel::may_discard() {
  const std::int64_t first = data_->branch ? data_->branch->start.world.step : 0;
  const bool saved = !is_live() || !data_->output.empty() ||
                     (data_->live->status().step == first && data_->commands.empty());
  if (saved || std::exchange(state.discard_asked, false)) return true;
  state.discard_asked = true;
  state.message = "This run is not saved. Press again to discard it, or s to save it.";
  return false;
}

void ViewModel::hold() {
  if (is_live())
    data_->live->halt();
  else
    data_->begin_series();
  if (data_->other) data_->other->hold();
}

Recording ViewModel::recording() const {
  return {data_->branch ? "" : data_->pictures.path, data_->scenario_settings, data_->output,
          data_->pictures.run.seed};
}

// --- replay ---

std::size_t ViewModel::frame_count() const { return data_->frame_count(); }
std::size_t ViewModel::frame_index() const { return data_->shown_index(); }
std::vector<double> ViewModel::frame_tilts() const {
  return data_->replay ? data_->frames->file().all_frame_tilts() : data_->frame_tilts();
}
bool ViewModel::has_program() const { return data_->pictures.has_program; }
std::span<const TimelineEvent> ViewModel::events() const { return data_->events; }
bool ViewModel::looks_back() const { return data_->held.has_value(); }
void ViewModel::follow() {
  if (data_->held) data_->hold_at(std::nullopt);
}

void ViewModel::go_to(std::size_t frame) {
  if (!data_->replay) return data_->hold_at(frame);
  data_->replay->go_to(frame);
  data_->show_replayed();
}

void ViewModel::go_to_angle(const std::string& angle) { go_to(data_->frame_at_angle(angle)); }

double ViewModel::tilt_of(const std::string& angle) const {
  return frame_tilts().at(data_->frame_at_angle(angle));
}

void ViewModel::go_to(Landmark landmark) {
  if (is_live() && landmark == Landmark::last) return follow();
  if (const auto frame = data_->place_of(landmark)) go_to(*frame);
}

bool ViewModel::has(Landmark landmark) const { return data_->place_of(landmark).has_value(); }

bool ViewModel::playing() const { return data_->replay && data_->replay->playing(); }

void ViewModel::play(bool on) {
  if (!data_->replay) return;
  data_->replay->play(on);
  data_->show_replayed();
}

void ViewModel::set_speed(double degrees_per_second) {
  if (data_->replay) data_->replay->set_speed(degrees_per_second);
}

double ViewModel::speed() const { return data_->replay ? data_->replay->speed() : 0.0; }

bool ViewModel::update(double seconds) {
  Data& data = *data_;
  bool changed = data.live && data.take_live();
  if (data.replay && data.replay->advance(seconds)) {
    data.show_replayed();
    changed = true;
  }
  changed = data.read_with(std::clamp(state.map.l_min, 0.0, 100.0)) || changed;
  changed = data.follow_frames(data.map_settings(state)) || changed;
  if (state.selecting.in_each_frame && data.condition_frame != data.frame) select_by_condition();
  changed = data.follow_history(state) || changed;
  follow_grain();
  state.camera = centred(clamped(state.camera, data.bed, mean_diameter()), data.part(state, data.aspect));
  changed = data.follow_beside(state, seconds) || changed;
  if (const std::string end = data.take_end(); !end.empty()) state.announcement = end;
  if (!data.error.empty()) state.message = std::exchange(data.error, {});
  return changed;
}

// --- what is shown ---

const RunStatics& ViewModel::statics() const { return data_->statics(); }
const Frame& ViewModel::frame() const { return *data_->frame; }
double ViewModel::theta_c() const { return data_->shown_theta_c(); }
bool ViewModel::theta_c_known() const { return data_->theta_c.has_value(); }
double ViewModel::mean_diameter() const { return data_->statics().mean_diameter; }

FrameView ViewModel::map(double aspect) const {
  data_->aspect = aspect;
  return data_->picture(state, data_->part(state, aspect), data_->map);
}

FrameView ViewModel::furnished_map() const { return data_->furnished(state, data_->map); }

const FrameView& ViewModel::annotated_map() const {
  return data_->whole_map(state, common_part(data_->part(state, data_->aspect), data_->bed), data_->map);
}

double ViewModel::bed_aspect() const { return data_->bed_aspect(state); }

std::array<double, 4> ViewModel::shown_region(double aspect) const {
  const MapExtent part = data_->part(state, aspect);
  return {part.x_min, part.x_max, part.y_min, part.y_max};
}

bool ViewModel::look(const ViewCamera& camera) {
  const MapExtent before = data_->part(state, data_->aspect);
  state.camera = clamped(camera, data_->bed, mean_diameter());
  const MapExtent now = data_->part(state, data_->aspect);
  state.camera = centred(state.camera, now);
  const double least = 1e-6 * mean_diameter();
  return std::abs(now.x_min - before.x_min) > least || std::abs(now.x_max - before.x_max) > least ||
         std::abs(now.y_min - before.y_min) > least || std::abs(now.y_max - before.y_max) > least;
}

bool ViewModel::zoom(double factor, double x, double y) {
  const ViewCamera before = state.camera;
  const double zoom = clamped({x, y, before.zoom * factor}, data_->bed, mean_diameter()).zoom;
  const double ratio = before.zoom / zoom;
  return look({x + (before.centre_x - x) * ratio, y + (before.centre_y - y) * ratio, zoom});
}

std::optional<Index> ViewModel::grain_at(double x, double y) const {
  return find_grain({*data_->frame, data_->statics()}, x, y);
}

const Inspection* ViewModel::inspection() const { return data_->inspect_selected(state); }
std::span<const Plot> ViewModel::plots() const { return data_->plots; }
std::vector<const Quantity*> ViewModel::more_quantities() const {
  std::vector<const Quantity*> more;
  for (const Quantity& quantity : quantities()) {
    const bool known = data_->analysis || quantity.display.observable || needs_threshold(quantity);
    const bool shown = std::ranges::find(data_->plots, quantity.name, &Plot::name) != data_->plots.end();
    if (known && !shown && is_number_of_frame(quantity)) more.push_back(&quantity);
  }
  return more;
}

void ViewModel::add_plot(const Quantity& quantity) {
  data_->plots.push_back(plot_of_quantity(quantity));
  name_axis(data_->axis, data_->plots);
  data_->plot_rows();
  data_->plot_values();
  data_->note_thresholds(data_->map_settings(state));
}

void ViewModel::remove_plot(const std::string& name) {
  std::erase_if(data_->plots, [&name](const Plot& plot) { return plot.added && plot.name == name; });
  state.plot_looks.erase(name);
  if (state.enlarged_plot == name) state.enlarged_plot.clear();
}

PlotAxis ViewModel::plot_axis() const { return data_->axis; }

bool ViewModel::has_plot_axis(PlotAxis axis) const {
  return axis != PlotAxis::angle_left || data_->theta_c.has_value();
}

void ViewModel::set_plot_axis(PlotAxis axis) {
  if (axis == data_->axis || !has_plot_axis(axis)) return;
  data_->axis = axis;
  name_axis(axis, data_->plots);
  data_->plot_rows();
  data_->plot_values();
  for (const Plot& plot : data_->plots) {
    if (!plot.along_run) continue;
    state.plot_looks[plot.name].zoomed.reset();
    state.plot_looks[plot.name].chosen.reset();
  }
}

void ViewModel::set_ghost(std::optional<Ghost> ghost) {
  data_->ghost = std::move(ghost);
  data_->plot_values();
}

const Ghost* ViewModel::ghost() const { return data_->ghost ? &*data_->ghost : nullptr; }

PlotMarks ViewModel::plot_marks() const {
  const PlotAbscissa abscissa = data_->abscissa();
  PlotMarks marks;
  marks.shown = place_on(abscissa, data_->frame->tilt, data_->frame->time);
  for (const TimelineEvent& event : data_->events) {
    const double place = place_on(abscissa, event.tilt, event.time);
    if (!std::isfinite(place)) continue;
    if (event.kind == TimelineEvent::Kind::failure) marks.theta_c = place;
    if (event.kind == TimelineEvent::Kind::rearrangement) marks.ticks.push_back(place);
  }
  return marks;
}

void ViewModel::go_to_place(double x) {
  std::optional<std::size_t> frame;
  if (data_->axis == PlotAxis::time)
    frame = nearest_frame(data_->replay ? data_->frames->file().all_frame_times() : data_->frame_times(), x);
  else if (data_->axis == PlotAxis::angle_left)
    frame = nearest_frame(magnitudes(frame_tilts(), {0, frame_tilts().size()}),
                          data_->theta_c.value_or(not_known) - radians(x));
  else
    frame = nearest_frame(frame_tilts(), radians(x));
  if (frame) go_to(*frame);
}

std::string ViewModel::render_command() const { return data_->render_command(state); }

}  // namespace talus
