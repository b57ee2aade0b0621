#include "view/scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/free_grains.h"
#include "analysis/links.h"
#include "core/errors.h"
#include "pictures/bed_view.h"
#include "pictures/change_map.h"
#include "pictures/texts.h"
#include "view/rings.h"

namespace talus {
namespace {

constexpr Colour length_colour{220, 50, 0}, circle_colour{70, 110, 170};
constexpr Colour cluster_colour{240, 130, 0}, light_wall{190, 196, 206};

void add_grains(FrameView& view, const FrameView& map) {
  view.discs.reserve(map.discs.size());
  for (const Disc& disc : map.discs)
    if (is_seen(view, disc)) view.discs.push_back(disc);
  for (const Line& line : map.lines)
    if (is_seen(view, line)) view.lines.push_back(line);
}

/// A stroke between each grain of a cluster and each neighbour that is not of it. Fills and rims of grains
/// stay as they are: a cluster can be most of the bed.
void add_outline(FrameView& view, const BedFrame& bed, const Clusters& clusters, Index cluster) {
  if (cluster < 0) return;
  const RunStatics& statics = bed.statics;
  const double period = period_of(statics);
  for (const Link& link : neighbour_links(bed)) {
    if ((clusters.label[link.a] == cluster) == (clusters.label[link.b] == cluster)) continue;
    const double r = statics.radius[link.a], x = bed.frame.x[link.a], y = bed.frame.y[link.a];
    const double dx = bed.frame.x[link.b] + link.shift * period - x, dy = bed.frame.y[link.b] - y;
    const double distance = std::hypot(dx, dy);
    const double ux = dx / distance, uy = dy / distance;
    const double reach = r + 0.5 * (distance - r - statics.radius[link.b]);
    const double half = 0.6 * std::min(r, statics.radius[link.b]);
    add_line(view,
             {static_cast<float>(x + reach * ux - half * uy), static_cast<float>(y + reach * uy + half * ux),
              static_cast<float>(x + reach * ux + half * uy), static_cast<float>(y + reach * uy - half * ux),
              static_cast<float>(0.07 * statics.mean_diameter), cluster_colour},
             statics);
  }
}

/// On a white ground, to be seen over dark grains and light ones.
void add_ring(FrameView& view, Vec2 centre, double radius, double half_width, const Colour& colour,
              const RunStatics& statics) {
  add_circle(view, centre, radius, 2.0 * half_width, white, statics);
  add_circle(view, centre, radius, half_width, colour, statics);
}

void add_overlay(FrameView& view, const BedFrame& bed, const Overlay& overlay) {
  if (!overlay.selected) return;
  const RunStatics& statics = bed.statics;
  const double d = statics.mean_diameter;
  const double pen = std::min(d, (view.x_max - view.x_min) / 60.0);  // finer where little is shown
  const auto grain = static_cast<std::size_t>(*overlay.selected);
  const Vec2 centre{bed.frame.x[grain], bed.frame.y[grain]};
  for (const double diameter : overlay.diameters)
    add_ring(view, centre, 0.5 * diameter, 0.05 * pen, circle_colour, statics);
  if (overlay.critical_length)
    add_ring(view, centre, 0.5 * *overlay.critical_length, 0.09 * pen, length_colour, statics);
  add_ring(view, centre, statics.radius[grain] + 0.05 * d, 0.08 * pen, selection_colour, statics);
}

/// Side walls, and a smooth floor; light where there is no white behind them.
void add_boundary(FrameView& view, const BedFrame& bed) {
  const RunStatics& statics = bed.statics;
  const Colour colour = view.transparent ? light_wall : black;
  const auto add = [&](double x0, double y0, double x1, double y1) {
    view.lines.push_back({static_cast<float>(x0), static_cast<float>(y0), static_cast<float>(x1),
                          static_cast<float>(y1), static_cast<float>(0.1 * statics.mean_diameter), colour});
  };
  const double low = std::max(view.y_min, std::min(0.0, view.y_max));
  if (!statics.periodic)
    for (const double x : {0.0, statics.length})
      if (x >= view.x_min && x <= view.x_max) add(x, low, x, view.y_max);
  const bool smooth = statics.free_count == bed.frame.grain_count();
  if (smooth && view.y_min <= 0.0 && view.y_max >= 0.0)
    add(std::max(0.0, view.x_min), 0.0, std::min(statics.length, view.x_max), 0.0);
}

/// What `draw` makes; where it cannot, the grains alone, with the reason as title.
template <typename Draw>
FrameView drawn_or_outlined(const PictureSeries& series, const Frame& frame, const Draw& draw) {
  try {
    return draw();
  } catch (const Error& error) {
    FrameView view = outlined_bed({frame, series.run.statics}, series.extent);
    view.furniture = true;
    view.tilt = frame.tilt;
    view.title = error.what();
    return view;
  }
}

/// Layers of a map; none where it cannot be drawn.
std::vector<MapLayer> layers_of(const MapSource& source, const RunStatics& statics) {
  const MapFrame of{{*source.frame, statics}, source.reference.get(), !source.since};
  try {
    if (source.change) return change_layers(of, source.settings, source.extent);
    std::vector<MapLayer> layers;
    for (std::size_t k = 0; k < source.settings.layers.size(); ++k)
      layers.push_back(make_layer(of, source.settings, source.extent, k));
    return layers;
  } catch (const Error&) {
    return {};
  }
}

}  // namespace

bool depends_on_extent(const MapLayers& layers) {
  return layers.size() > 1 && layers[1] == MapKind::displacement;
}

MapSource source_of(const PictureSeries& series, std::size_t k, std::shared_ptr<const Frame> frame,
                    std::shared_ptr<const Frame> reference) {
  const MapSettings& settings = series.plan.maps[0];
  const bool coloured = shows(settings.layers, MapKind::clusters);
  const std::size_t needed = coloured ? k + 1 : shows(settings.layers, MapKind::dyed) ? 1 : 0;
  const std::size_t met = std::min(series.met.instants.size(), needed);
  return {std::move(frame), std::move(reference), settings, series.extent, series.since, met};
}

FrameView draw_map(const PictureSeries& series, std::size_t k, const Frame& frame, const Frame* reference) {
  return drawn_or_outlined(series, frame, [&] { return picture(series, k, frame, reference, 0); });
}

FrameView draw_change(const PictureSeries& series, const Frame& frame, const Frame* reference) {
  const MapFrame of{{frame, series.run.statics}, reference, false};
  return drawn_or_outlined(series, frame,
                           [&] { return make_change_map(of, series.plan.maps[0], series.extent); });
}

GrainValues grain_values(const MapSource& source, const RunStatics& statics) {
  for (const MapLayer& layer : layers_of(source, statics))
    if (!layer.values.empty()) return {layer.values, layer.legend.bars.at(0).title};
  return {};
}

std::optional<ScaleRange> own_range(const MapSource& source, const RunStatics& statics) {
  MapSource own = source;
  own.settings.range_low.reset();
  own.settings.range_high.reset();
  for (const MapLayer& layer : layers_of(own, statics))
    if (layer.scale) return ScaleRange{layer.scale->low, layer.scale->high};
  return std::nullopt;
}

std::vector<double> growing_diameters(double largest) {
  if (!(largest > 0.0)) return {};
  const double step = round_step(largest, 5);
  std::vector<double> diameters;
  for (int k = 1; k * step < largest - 0.25 * step; ++k) diameters.push_back(k * step);
  diameters.push_back(largest);
  return diameters;
}

FrameView shown_map(const FrameView& map, const MapExtent& part, const BedFrame& bed, const Overlay& overlay,
                    const Clusters& clusters) {
  FrameView view = empty_view(part);
  view.turn = map.turn;
  view.turn_max = map.turn_max;
  view.tilt = map.tilt;
  view.coloured = true;  // one target for all that is shown
  view.transparent = map.transparent;
  add_grains(view, map);
  add_boundary(view, bed);
  add_outline(view, bed, clusters, overlay.cluster);
  add_overlay(view, bed, overlay);
  return view;
}

}  // namespace talus
