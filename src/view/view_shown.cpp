#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "core/trigonometry.h"
#include "pictures/bed_view.h"
#include "pictures/frame_choice.h"
#include "view/camera.h"
#include "view/dark_map.h"
#include "view/render_command.h"
#include "view/view_data.h"

namespace talus {

std::vector<double> ViewModel::Data::frame_tilts() const {
  if (replay) return frames->file().frame_tilts();
  std::vector<double> tilts;
  for (const auto& recorded_frame : recorded->all()) tilts.push_back(recorded_frame->tilt);
  return tilts;
}

std::vector<double> ViewModel::Data::all_frame_times() const {
  if (replay) return frames->file().all_frame_times();
  std::vector<double> times;
  for (const auto& recorded_frame : recorded->all()) times.push_back(recorded_frame->time);
  return times;
}

std::vector<double> ViewModel::Data::frame_times() const {
  std::vector<double> times = all_frame_times();
  if (replay) times.resize(frames->file().frame_count());
  return times;
}

std::size_t ViewModel::Data::shown_index() const {
  if (replay) return replay->index();
  const auto& all = recorded->all();
  const auto after = std::ranges::partition_point(
      all, [this](const std::shared_ptr<const Frame>& of) { return of->step < frame->step; });
  return static_cast<std::size_t>(after - all.begin());
}

double ViewModel::Data::shown_theta_c() const {
  return theta_c.value_or(parent_theta_c.value_or(radians(assumed_theta_c)));
}

MapSettings ViewModel::Data::map_settings(const ViewState& asked) const {
  MapSettings settings = asked.map;
  if (settings.layers.empty()) settings.layers = {MapKind::gamma};
  settings.theta_c = shown_theta_c();
  settings.theta_c_assumed = !theta_c;
  settings.l_min = l_min;
  settings.length = std::clamp(settings.length, 1.0, statics().length / statics().mean_diameter);
  settings.furniture = true;
  if (linked.range && asked.map.layers == linked.layers && !settings.range_low && !settings.range_high) {
    settings.range_low = linked.range->low;
    settings.range_high = linked.range->high;
  }
  settings.tilt_max = 0.0;
  if (settings.turned)  // all frames in one size
    settings.tilt_max =
        replay ? std::ranges::max(frames->file().all_frame_tilts()) : std::max(shown_theta_c(), frame->tilt);
  return settings;
}

const Clusters& ViewModel::Data::shown_clusters(const MapSettings& settings) {
  const OverloadRule& rule = settings;
  if (clusters.frame != frame || !(clusters.rule == rule))
    clusters = {frame, rule, overloaded_clusters({*frame, statics()}, settings)};
  return clusters.clusters;
}

const Inspection* ViewModel::Data::inspect_selected(const ViewState& asked) {
  if (!asked.selected || *asked.selected < 0 || *asked.selected >= frame->grain_count()) return nullptr;
  const MapSettings by = map_settings(asked);
  const OverloadRule& rule = by;
  if (inspection.frame != frame || !(inspection.rule == rule) ||
      inspection.neighbourhood != asked.neighbourhood || inspection.of.grain != *asked.selected) {
    const double widest =
        statics().periodic ? statics().length : 2.0 * std::max(statics().length, statics().depth);
    const double neighbourhood = std::clamp(asked.neighbourhood * statics().mean_diameter, 0.0, widest);
    inspection = {frame, rule, asked.neighbourhood,
                  inspect({*frame, statics()}, shown_clusters(by),
                          {.threshold = threshold_of(rule),
                           .l_min = l_min * statics().mean_diameter,
                           .cut = length_cut(statics(), l_min),
                           .neighbourhood = neighbourhood},
                          *asked.selected)};
  }
  return &inspection.of;
}

MapExtent ViewModel::Data::viewed_bed() const {
  MapExtent viewed = bed;
  if (bed_beside) extend(viewed, *bed_beside);
  return viewed;
}

double ViewModel::Data::bed_aspect(const ViewState& asked) const {
  const MapExtent viewed = viewed_bed();
  return picture_aspect((viewed.y_max - viewed.y_min) / (viewed.x_max - viewed.x_min),
                        std::max(0.0, map_settings(asked).tilt_max));
}

MapExtent ViewModel::Data::part(const ViewState& asked, double shown_aspect) const {
  const double turn_max = std::max(0.0, map_settings(asked).tilt_max);
  return shown_part(asked.camera, viewed_bed(), statics().mean_diameter,
                    shown_aspect > 0.0 ? shown_aspect : bed_aspect(asked), turn_max);
}

std::optional<double> ViewModel::Data::since_of(const ViewState& asked) const {
  return asked.since && *asked.since < frame->tilt ? asked.since : std::nullopt;
}

std::size_t ViewModel::Data::frame_at_angle(const std::string& angle) const {
  if (!replay)
    throw Error(ExitCode::usage,
                pictures.path + ": this run is being computed, so it has no frames to go to");
  return frames_at(frames->file().frame_tilts(), {angle}, theta_c.value_or(not_known)).front();
}

std::shared_ptr<const Frame> ViewModel::Data::frame_at(std::size_t k) {
  return replay ? read(k) : recorded->all()[k];
}

std::shared_ptr<const Frame> ViewModel::Data::reference_at(double tilt) {
  const auto k = nearest_frame(frame_tilts(), tilt);
  auto of = k ? frame_at(*k) : nullptr;
  if (!of || of->grain_count() != frame->grain_count()) return nullptr;  // while a bed is poured
  if (reference.stored != of || reference.l_min != l_min)
    reference = {of, std::make_shared<const Frame>(mapped_frame(*of, statics(), l_min)), l_min};
  return reference.mapped;
}

const FrameView& ViewModel::Data::whole_map(const ViewState& asked, const MapExtent& shown, MapCache& cache) {
  pictures.plan.maps = {map_settings(asked)};
  pictures.extent = depends_on_extent(asked.map.layers) ? common_part(shown, bed) : bed;
  pictures.since.reset();
  if (const auto since = since_of(asked)) {
    const std::vector<double> tilts = frame_tilts();
    const auto first = tilts.empty() ? std::nullopt : frame_near(tilts, *since);
    pictures.since = first ? first : nearest_frame(tilts, *since).value_or(0);
  }
  const std::size_t k = shown_index();
  const bool dark = asked.theme == Theme::dark;
  const auto keep = [&](MapSource source, FrameView view) {
    cache = {std::move(source), dark, dark ? on_dark_ground(std::move(view)) : std::move(view), std::nullopt};
  };
  if (asked.minus) {
    MapSource source = source_of(pictures, k, frame, reference_at(*asked.minus));
    source.change = true;
    if (!(cache.source == source) || cache.dark != dark)
      keep(source, draw_change(pictures, *frame, source.reference.get()));
    return cache.view;
  }
  const std::optional<std::size_t> from = reference_of(pictures, k);
  const std::shared_ptr<const Frame> moved_from = from ? frame_at(*from) : nullptr;
  MapSource source = source_of(pictures, k, frame, moved_from);
  if (!(cache.source == source) || cache.dark != dark)
    keep(source, draw_map(pictures, k, *frame, moved_from.get()));
  return cache.view;
}

FrameView ViewModel::Data::picture(const ViewState& asked, const MapExtent& shown, MapCache& cache) {
  Overlay overlay;
  if (const Inspection* of = inspect_selected(asked)) {
    overlay.selected = of->grain;
    if (asked.highlight_cluster) overlay.cluster = of->cluster;
    if (asked.show_neighbourhoods && of->free) {
      for (const double diameter : growing_diameters(asked.neighbourhood))
        overlay.diameters.push_back(diameter * statics().mean_diameter);
      overlay.critical_length = of->coarse_graining_length;
    }
  }
  FrameView view = shown_map(whole_map(asked, shown, cache), shown, {*frame, statics()}, overlay,
                             shown_clusters(map_settings(asked)));
  add_selection(view, {*frame, statics()}, selection_marks(asked));
  return view;
}

FrameView ViewModel::Data::furnished(const ViewState& shown, MapCache& cache) {
  ViewState asked = shown;
  asked.theme = Theme::light;  // on paper
  const MapExtent seen = common_part(part(asked, aspect), bed);
  const FrameView& whole = whole_map(asked, seen, cache);
  FrameView view = picture(asked, seen, cache);
  add_surroundings(view, {*frame, statics()});
  view.furniture = true;
  view.transparent = whole.transparent;
  view.letters = whole.letters;
  view.title = whole.title;
  view.caption = whole.caption;
  view.legends = whole.legends;
  return view;
}

std::string ViewModel::Data::render_command(const ViewState& asked) const {
  RenderRequest shown;
  shown.run = pictures.path;
  shown.settings = map_settings(asked);
  shown.tilt = frame->tilt;
  shown.since = since_of(asked);
  shown.mean_diameter = statics().mean_diameter;
  if (pictures.has_program && frame_count() > 0) shown.frame = std::min(shown_index(), frame_count() - 1);
  if (replay && replay->index() >= frames->file().frame_count()) {
    shown.in_flow = true;
    shown.tilt = frames->file().frame_tilts().back();
    if (shown.frame) shown.frame = frames->file().frame_count() - 1;
  }
  if (!replay) {
    if (output.empty()) return {};
    const auto nearest = nearest_frame(frame_tilts(), frame->tilt);
    if (!nearest) return {};
    shown.run = output;
    shown.tilt = recorded->all()[*nearest]->tilt;
  }
  const MapExtent seen = common_part(part(asked, aspect), bed);
  if (!(seen == bed)) shown.part = seen;
  return render_command_line(shown);
}

}  // namespace talus
