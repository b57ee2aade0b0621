/// Results for the frame shown: its maps and the selection; curves and events of the run.

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/failure/transition.h"
#include "core/trigonometry.h"
#include "pictures/bed_view.h"
#include "pictures/frame_choice.h"
#include "pictures/layers.h"
#include "runs/event_catalogue.h"
#include "session/command.h"
#include "view/scene.h"
#include "view/view_model.h"
#include "view/view_state.h"

namespace talus::view {

double ViewModel::theta_c() const {
  return theta_c_.value_or(parent_theta_c_.value_or(radians(pictures::assumed_theta_c)));
}

pictures::MapSettings View::settings() const {
  pictures::MapSettings settings = chosen;
  if (settings.layers.empty()) settings.layers = {pictures::MapKind::gamma};
  settings.theta_c = run.theta_c();
  settings.theta_c_assumed = !run.theta_c_known();
  settings.l_min = run.l_min_;
  settings.length = std::clamp(settings.length, 1.0, run.statics().length / run.mean_diameter());
  settings.furniture = true;
  settings.tilt_max = 0.0;
  if (settings.turned)  // the same size for all frames
    settings.tilt_max =
        run.is_live() ? std::max(run.theta_c(), run.frame().tilt) : std::ranges::max(run.frame_tilts());
  return settings;
}

const analysis::Clusters& View::clusters() const {
  auto& known = run.clusters_;
  const pictures::OverloadRule& rule = settings();
  if (known.frame != run.frame_ || !(known.rule == rule))
    known = {run.frame_, rule, pictures::overloaded_clusters(run.bed(), rule)};
  return known.clusters;
}

const Inspection* View::inspection() const {
  const std::optional<Index>& grain = run.state.selected;
  if (!grain || *grain < 0 || *grain >= run.frame_->grain_count()) return nullptr;
  const pictures::OverloadRule& rule = settings();
  const double drawn = run.state.neighbourhood;
  auto& known = run.inspection_;
  if (known.frame != run.frame_ || !(known.rule == rule) || known.neighbourhood != drawn ||
      known.result.grain != *grain) {
    const RunStatics& statics = run.statics();
    const double widest = statics.periodic ? statics.length : 2.0 * std::max(statics.length, statics.depth);
    const double neighbourhood = std::clamp(drawn * statics.mean_diameter, 0.0, widest);
    known = {run.frame_, rule, drawn,
             inspect(run.bed(), clusters(), coarse_graining_rule(rule, statics), neighbourhood, *grain)};
  }
  return &known.result;
}

View ViewModel::second() {
  View view{*this, state.map, state.second_view.minus, second_map_, true};
  if (!state.second_view.layers.empty()) {
    view.chosen.layers = state.second_view.layers;
    view.chosen.own.reset();
  }
  if (view.minus || view.chosen.layers != state.map.layers ||
      view.chosen.own != state.map.own) {  // the range is of another map
    view.chosen.range_low.reset();
    view.chosen.range_high.reset();
  }
  return view;
}

double View::bed_aspect() const {
  const pictures::MapExtent& bed = run.bed_;
  return picture_aspect((bed.y_max - bed.y_min) / (bed.x_max - bed.x_min),
                        std::max(0.0, settings().tilt_max));
}

pictures::MapExtent View::part(double aspect) const {
  return shown_part(run.state.camera, run.bed_, run.mean_diameter(), aspect > 0.0 ? aspect : bed_aspect(),
                    std::max(0.0, settings().tilt_max));
}

std::optional<double> View::since() const {
  const std::optional<double>& from = run.state.since;
  return from && *from < run.frame().tilt ? from : std::nullopt;
}

std::shared_ptr<const Frame> View::reference() const {
  pictures::PictureSeries& pictures = run.pictures_;
  pictures.since.reset();
  const std::vector<double> tilts = run.tilts_of_tilt();
  if (minus) {
    const auto k = pictures::nearest_frame(tilts, *minus);
    auto stored = k ? run.frame_at(*k) : nullptr;
    if (!stored || stored->grain_count() != run.frame().grain_count()) return nullptr;  // a bed being poured
    auto& known = run.reference_;
    if (known.stored != stored || known.l_min != run.l_min_)
      known = {stored,
               std::make_shared<const Frame>(pictures::mapped_frame(*stored, run.statics(), run.l_min_)),
               run.l_min_};
    return known.mapped;
  }
  if (!pictures::any_layer(chosen.layers, pictures::needs_reference)) return nullptr;
  if (const auto from = since()) {
    const auto first = tilts.empty() ? std::nullopt : pictures::frame_near(tilts, *from);
    pictures.since = first ? first : pictures::nearest_frame(tilts, *from).value_or(0);
  }
  const auto before = pictures::reference_frame(run.frame_index(), pictures.since);
  return before ? run.frame_at(*before) : nullptr;
}

const render::FrameView& View::whole_map(const pictures::MapExtent& shown, bool dark) const {
  pictures::PictureSeries& pictures = run.pictures_;
  pictures.plan.maps = {settings()};
  const bool arrows = chosen.layers.size() > 1 && chosen.layers[1] == pictures::MapKind::displacement;
  pictures.extent =
      arrows ? common_part(shown, run.bed_) : run.bed_;  // arrows are spread over the part shown
  const std::size_t k = run.frame_index();
  const std::shared_ptr<const Frame> before = reference();
  MapKey key = map_key(pictures, k, run.frame_, before, minus.has_value());
  if (cache.key == key && cache.dark == dark) return cache.view;
  render::FrameView view = draw_map(pictures, k, run.frame(), before.get(), minus.has_value());
  cache = {std::move(key), dark, dark ? on_dark_ground(std::move(view)) : std::move(view)};
  return cache.view;
}

render::FrameView View::picture(const pictures::MapExtent& shown, bool dark) const {
  const Selection& selection = run.state.selecting.selection;
  Overlay overlay;
  for (const Index grain : selection.grains)
    if (grain < run.frame().grain_count()) overlay.grains.push_back(grain);
  if (selection.contact) overlay.contact = contact_of_key(run.frame().contacts, *selection.contact);
  if (const Inspection* inspection = this->inspection()) {
    overlay.selected = inspection->grain;
    if (run.state.highlight_cluster) overlay.cluster = inspection->cluster;
    if (run.state.show_neighbourhoods && inspection->free) {
      for (const double diameter : growing_diameters(run.state.neighbourhood))
        overlay.diameters.push_back(diameter * run.mean_diameter());
      overlay.critical_length = inspection->coarse_graining_length;
    }
  }
  render::FrameView view = shown_map(whole_map(shown, dark), shown, run.bed());
  add_overlay(view, run.bed(), overlay, clusters(), run.bed_);
  return view;
}

render::FrameView View::map(double aspect) const {
  run.aspect_ = aspect;
  return picture(part(aspect), run.state.theme == Theme::dark);
}

const render::FrameView& View::annotated_map() const {
  return whole_map(common_part(part(run.aspect_), run.bed_), run.state.theme == Theme::dark);
}

render::FrameView View::furnished_map() const {
  const pictures::MapExtent seen = common_part(part(run.aspect_), run.bed_);
  render::FrameView view = picture(seen, false);
  const render::FrameView& whole = whole_map(seen, false);
  pictures::add_surroundings(view, run.bed());
  view.furniture = true;
  view.title = whole.title;
  view.caption = whole.caption;
  view.legends = whole.legends;
  return view;
}

std::optional<pictures::ScaleRange> View::fitting_range() const {
  const pictures::MapSettings map = settings();
  const std::optional<pictures::MapKind> moving = moving_layer(map.layers);
  if (!moving) return std::nullopt;
  const std::shared_ptr<const Frame> before = reference();
  const analysis::GrainSource frame{run.bed(), before.get(), !run.pictures_.since};
  pictures::MotionSample sample({*moving}, map);
  sample.add(frame);
  const bool per_degree = pictures::needs_reference(*moving) && pictures::motion_span(frame).per_degree;
  return sample.ranges().range(*moving, per_degree);
}

const render::Bar* View::bar() const {
  for (const render::Legend& legend : annotated_map().legends)
    if (!legend.bars.empty()) return &legend.bars.front();
  return nullptr;
}

bool ViewModel::set_camera(const ViewCamera& camera) {
  const pictures::MapExtent before = first().part(aspect_);
  state.camera = clamped(camera, bed_, mean_diameter());
  const pictures::MapExtent now = first().part(aspect_);
  state.camera = centred(state.camera, now);
  const double least = 1e-6 * mean_diameter();
  return std::abs(now.x_min - before.x_min) > least || std::abs(now.x_max - before.x_max) > least ||
         std::abs(now.y_min - before.y_min) > least || std::abs(now.y_max - before.y_max) > least;
}

bool ViewModel::zoom(double factor, double x, double y) {
  const ViewCamera before = state.camera;
  const double zoom = clamped({x, y, before.zoom * factor}, bed_, mean_diameter()).zoom;
  const double ratio = before.zoom / zoom;
  return set_camera({x + (before.centre_x - x) * ratio, y + (before.centre_y - y) * ratio, zoom});
}

std::string ViewModel::render_command() {
  const View view = first();
  RenderRequest shown;
  shown.run = path();
  shown.settings = view.settings();
  shown.tilt = frame().tilt;
  shown.since = view.since();
  shown.mean_diameter = mean_diameter();
  const RunInstants& run_instants = frames_->instants();
  if (goes_by_time() && frame_count() > 0) shown.frame = std::min(frame_index(), frame_count() - 1);
  if (replay_ && frame_index() >= run_instants.tilt_count) {
    shown.in_flow = true;
    shown.tilt = run_instants.tilts[run_instants.tilt_count - 1];
    if (shown.frame) shown.frame = run_instants.tilt_count - 1;
  }
  if (is_live()) {
    const auto nearest = pictures::nearest_frame(run_instants.tilts, frame().tilt);
    if (recording_.output.empty() || !nearest) return {};
    shown.run = recording_.output;
    shown.tilt = run_instants.tilts[*nearest];
  }
  const pictures::MapExtent seen = common_part(view.part(aspect_), bed_);
  if (!(seen == bed_)) shown.part = seen;
  return render_command_line(shown);
}

std::optional<ContactInspection> ViewModel::contact_inspection() const {
  const std::optional<ContactKey>& contact = state.selecting.selection.contact;
  return contact ? std::optional(inspect_contact(bed(), *contact)) : std::nullopt;
}

std::vector<Plot> ViewModel::contact_history() const {
  if (!reader_->contact()) return {};
  const double weight = runs::mean_grain_mass(all_statics_) * statics().gravity;
  return contact_plots(reader_->history(), weight, abscissa());
}

void ViewModel::select(std::optional<Index> grain) {
  state.selected = grain;
  state.selecting.selection = {};
}

void ViewModel::select(std::vector<Index> grains) {
  state.selecting.selection = {};
  if (grains.size() == 1) state.selected = grains.front();
  if (state.selected && !std::ranges::binary_search(grains, *state.selected)) state.selected.reset();
  if (grains.size() > 1) state.selecting.selection.grains = std::move(grains);
}

void ViewModel::select(const ContactKey& contact) {
  select(std::optional<Index>());
  state.selecting.selection.contact = contact;
}

std::vector<Index> ViewModel::selected_grains() const {
  std::vector<Index> grains = state.selecting.selection.grains;
  if (grains.empty() && state.selected) grains = {*state.selected};
  std::erase_if(grains, [this](Index i) { return i < 0 || i >= frame_->grain_count(); });
  return grains;
}

// The curves and events of the run.

void ViewModel::plot_rows() { plot_observables(rows_, statics(), abscissa(), plots_); }

void ViewModel::plot_values() {
  const std::vector<double>& times = frames_->instants().times;
  plot_frames(reader_->values(), times, mean_diameter(), abscissa(), plots_);
  if (analysis_) plot_frames(analysis_->frames, times, mean_diameter(), abscissa(), plots_, true);
  const pictures::OverloadRule& rule = reader_->rule();
  note_threshold(rule.threshold_factor, theta_c_ ? std::nullopt : std::optional(rule.theta_c), plots_);
}

bool ViewModel::all_values_known() const {
  return replay_ && (reader_->values().size() >= frames_->instants().tilt_count || !reader_->error().empty());
}

std::vector<const analysis::Quantity*> ViewModel::more_quantities() const {
  std::vector<const analysis::Quantity*> more;
  for (const analysis::Quantity& quantity : analysis::quantities()) {
    const bool known = analysis_ || quantity.display.observable || analysis::needs_threshold(quantity);
    const bool shown = std::ranges::find(plots_, quantity.name, &Plot::name) != plots_.end();
    if (known && !shown && analysis::is_number_of_frame(quantity)) more.push_back(&quantity);
  }
  return more;
}

void ViewModel::add_plot(const analysis::Quantity& quantity) {
  plots_.push_back(plot_of_quantity(quantity));
  name_axis(axis_, plots_);
  plot_rows();
  plot_values();
}

void ViewModel::remove_plot(const std::string& name) {
  std::erase_if(plots_, [&name](const Plot& plot) { return plot.added && plot.name == name; });
  state.plot_options.erase(name);
  if (state.enlarged_plot == name) state.enlarged_plot.clear();
}

void ViewModel::set_plot_axis(PlotAxis axis) {
  if (axis == axis_ || !has_plot_axis(axis)) return;
  axis_ = axis;
  name_axis(axis_, plots_);
  plot_rows();
  plot_values();
  for (const Plot& plot : plots_) {
    if (!plot.along_run) continue;
    state.plot_options[plot.name].zoomed.reset();
    state.plot_options[plot.name].chosen.reset();
  }
}

PlotMarks ViewModel::plot_marks() const {
  PlotMarks marks;
  marks.shown = place_on(abscissa(), frame_->tilt, frame_->time);
  for (const TimelineEvent& event : events_) {
    const double place = place_on(abscissa(), event.tilt, event.time);
    if (!std::isfinite(place)) continue;
    if (event.kind == TimelineEvent::Kind::failure) marks.theta_c = place;
    if (event.kind == TimelineEvent::Kind::rearrangement) marks.ticks.push_back(place);
  }
  return marks;
}

void ViewModel::go_to_place(double x) {
  const RunInstants& run_instants = frames_->instants();
  const auto frame =
      axis_ == PlotAxis::time ? pictures::nearest_frame(run_instants.times, x)
      : axis_ == PlotAxis::angle_left
          ? pictures::nearest_frame(analysis::magnitudes(run_instants.tilts, {0, run_instants.tilts.size()}),
                                    theta_c_.value_or(not_known) - radians(x))
          : pictures::nearest_frame(run_instants.tilts, radians(x));
  if (frame) go_to(*frame);
}

void ViewModel::find_events() {
  TimelineSource source;
  source.tilts = tilts_of_tilt();
  source.times = frames_->instants().of_tilt(frames_->instants().times);
  source.rows = rows_;
  source.values = reader_->values();
  const std::vector<Command> given = session::given_commands(commands_);
  source.commands = given;
  if (live_ && !given.empty())
    command_rows_ = session::rows_up_to(rows_, newest_->step, newest_->time, newest_->tilt);
  source.command_rows = command_rows_;
  if (analysis_) source.rearrangements = analysis_->events;
  source.energy_unit = runs::mean_grain_mass(all_statics_) * statics().gravity * mean_diameter();
  source.theta_c = theta_c_;
  source.mean_diameter = statics().mean_diameter;
  source.cut = analysis::length_cut(statics(), reader_->rule().l_min);
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
  const auto event = std::ranges::find(events_, text_of(landmark).event, &TimelineEvent::name);
  return event == events_.end() ? std::nullopt : std::optional(event->frame);
}

}  // namespace talus::view
