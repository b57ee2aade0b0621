/// Results for the frame shown: its maps, and the properties of its grains.

#include <algorithm>
#include <cmath>

#include "core/trigonometry.h"
#include "pictures/bed_view.h"
#include "pictures/frame_choice.h"
#include "view/camera.h"
#include "view/dark_map.h"
#include "view/render_command.h"
#include "view/view_model.h"

namespace talus::view {

double ViewModel::theta_c() const {
  return theta_c_.value_or(parent_theta_c_.value_or(radians(pictures::assumed_theta_c)));
}

pictures::MapSettings View::settings() const {
  pictures::MapSettings settings = state.map;
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

const analysis::Clusters& ViewModel::shown_clusters(const pictures::MapSettings& settings) {
  const pictures::OverloadRule& rule = settings;
  if (clusters_.frame != frame_ || !(clusters_.rule == rule))
    clusters_ = {frame_, rule, pictures::overloaded_clusters(bed(), settings)};
  return clusters_.clusters;
}

const Inspection* ViewModel::inspect_selected(const View& view) {
  const ViewState& asked = view.state;
  if (!asked.selected || *asked.selected < 0 || *asked.selected >= frame_->grain_count()) return nullptr;
  const pictures::MapSettings by = view.settings();
  const pictures::OverloadRule& rule = by;
  if (inspection_.frame != frame_ || !(inspection_.rule == rule) ||
      inspection_.neighbourhood != asked.neighbourhood || inspection_.result.grain != *asked.selected) {
    const double widest =
        statics().periodic ? statics().length : 2.0 * std::max(statics().length, statics().depth);
    const double neighbourhood = std::clamp(asked.neighbourhood * statics().mean_diameter, 0.0, widest);
    inspection_ = {frame_, rule, asked.neighbourhood,
                   inspect(bed(), shown_clusters(by), coarse_graining_rule(rule, statics()), neighbourhood,
                           *asked.selected)};
  }
  return &inspection_.result;
}

View ViewModel::second() {
  second_state_ = state;
  if (!state.second_view.layers.empty()) second_state_.map.layers = state.second_view.layers;
  second_state_.minus = state.second_view.minus;
  if (second_state_.minus || second_state_.map.layers != state.map.layers) {  // the range is of another map
    second_state_.map.range_low.reset();
    second_state_.map.range_high.reset();
  }
  return {*this, second_state_, second_map_, true};
}

double View::bed_aspect() const {
  const pictures::MapExtent& bed = run.bed_;
  return picture_aspect((bed.y_max - bed.y_min) / (bed.x_max - bed.x_min),
                        std::max(0.0, settings().tilt_max));
}

pictures::MapExtent View::part(double aspect) const {
  return shown_part(state.camera, run.bed_, run.mean_diameter(), aspect > 0.0 ? aspect : bed_aspect(),
                    std::max(0.0, settings().tilt_max));
}

std::optional<double> View::since() const {
  return state.since && *state.since < run.frame().tilt ? state.since : std::nullopt;
}

std::shared_ptr<const Frame> ViewModel::reference_at(double tilt) {
  const auto k = pictures::nearest_frame(tilts_of_tilt(), tilt);
  auto reference = k ? frame_at(*k) : nullptr;
  if (!reference || reference->grain_count() != frame_->grain_count())
    return nullptr;  // while a bed is poured
  if (reference_.stored != reference || reference_.l_min != l_min_)
    reference_ = {reference,
                  std::make_shared<const Frame>(pictures::mapped_frame(*reference, statics(), l_min_)),
                  l_min_};
  return reference_.mapped;
}

std::shared_ptr<const Frame> View::reference() const {
  pictures::PictureSeries& pictures = run.pictures_;
  pictures.since.reset();
  if (const auto from = since()) {
    const std::vector<double> tilts = run.tilts_of_tilt();
    const auto first = tilts.empty() ? std::nullopt : pictures::frame_near(tilts, *from);
    pictures.since = first ? first : pictures::nearest_frame(tilts, *from).value_or(0);
  }
  const auto from = pictures::reference_frame(run.frame_index(), pictures.since);
  return from ? run.frame_at(*from) : nullptr;
}

const render::FrameView& View::whole_map(const pictures::MapExtent& shown) const {
  pictures::PictureSeries& pictures = run.pictures_;
  pictures.plan.maps = {settings()};
  pictures.extent = depends_on_extent(state.map.layers) ? common_part(shown, run.bed_) : run.bed_;
  const std::size_t k = run.frame_index();
  std::shared_ptr<const Frame> reference;
  pictures.since.reset();
  if (pictures::any_layer(state.map.layers, pictures::needs_reference)) reference = this->reference();
  if (state.minus) reference = run.reference_at(*state.minus);
  MapSource source = source_of(pictures, k, run.frame_, reference);
  source.change = state.minus.has_value();
  const bool dark = state.theme == Theme::dark;
  if (cache.source == source && cache.dark == dark) return cache.view;
  render::FrameView view = source.change ? draw_change(pictures, run.frame(), reference.get())
                                         : draw_map(pictures, k, run.frame(), reference.get());
  cache = {std::move(source), dark, dark ? on_dark_ground(std::move(view)) : std::move(view), std::nullopt};
  return cache.view;
}

render::FrameView View::picture(const pictures::MapExtent& shown) const {
  Overlay overlay = run.selection_marks();
  if (const Inspection* inspection = run.inspect_selected(*this)) {
    overlay.selected = inspection->grain;
    if (state.highlight_cluster) overlay.cluster = inspection->cluster;
    if (state.show_neighbourhoods && inspection->free) {
      for (const double diameter : growing_diameters(state.neighbourhood))
        overlay.diameters.push_back(diameter * run.mean_diameter());
      overlay.critical_length = inspection->coarse_graining_length;
    }
  }
  render::FrameView view = shown_map(whole_map(shown), shown, run.bed());
  add_overlay(view, run.bed(), overlay, run.shown_clusters(settings()));
  return view;
}

render::FrameView View::map(double aspect) const {
  run.aspect_ = aspect;
  return picture(part(aspect));
}

const render::FrameView& View::annotated_map() const {
  return whole_map(common_part(part(run.aspect_), run.bed_));
}

render::FrameView View::furnished_map() const {
  ViewState on_paper = state;
  on_paper.theme = Theme::light;
  const View paper_view{run, on_paper, cache, second};
  const pictures::MapExtent seen = common_part(paper_view.part(run.aspect_), run.bed_);
  const render::FrameView& whole = paper_view.whole_map(seen);
  render::FrameView view = paper_view.picture(seen);
  pictures::add_surroundings(view, run.bed());
  view.furniture = true;
  view.transparent = whole.transparent;
  view.letters = whole.letters;
  view.title = whole.title;
  view.caption = whole.caption;
  view.legends = whole.legends;
  return view;
}

const GrainValues& View::values() const {
  if (!cache.values)
    cache.values = cache.source.frame ? grain_values(cache.source, run.statics()) : GrainValues{};
  return *cache.values;
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
    if (output_.empty() || !nearest) return {};
    shown.run = output_;
    shown.tilt = run_instants.tilts[*nearest];
  }
  const pictures::MapExtent seen = common_part(view.part(aspect_), bed_);
  if (!(seen == bed_)) shown.part = seen;
  return render_command_line(shown);
}

}  // namespace talus::view
