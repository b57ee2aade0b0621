#include "view/scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/errors.h"
#include "pictures/bed_view.h"
#include "pictures/change_map.h"

namespace talus::view {
namespace {

constexpr render::Colour light_wall{190, 196, 206};

void add_grains(render::FrameView& view, const render::FrameView& map) {
  view.discs.reserve(map.discs.size());
  for (const render::Disc& disc : map.discs)
    if (pictures::is_seen(view, disc)) view.discs.push_back(disc);
  for (const render::Line& line : map.lines)
    if (pictures::is_seen(view, line)) view.lines.push_back(line);
}

/// Adds side walls and a smooth floor, in a light colour if the background is not white.
void add_boundary(render::FrameView& view, const BedFrame& bed) {
  const RunStatics& statics = bed.statics;
  const render::Colour colour = view.transparent ? light_wall : render::black;
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

/// Returns the result of `draw`; if it fails, the grains alone, with the reason as title.
template <typename Draw>
render::FrameView drawn_or_outlined(const pictures::PictureSeries& series, const Frame& frame,
                                    const Draw& draw) {
  try {
    return draw();
  } catch (const Error& error) {
    render::FrameView view = pictures::outlined_bed({frame, series.run.statics}, series.extent);
    view.furniture = true;
    view.tilt = frame.tilt;
    view.title = error.what();
    return view;
  }
}

/// Returns the layers of a map; none if it cannot be drawn.
std::vector<pictures::MapLayer> layers_of(const MapSource& source, const RunStatics& statics) {
  const pictures::MapFrame bed{{*source.frame, statics}, source.reference.get(), !source.since};
  try {
    if (source.change) return pictures::change_layers(bed, source.settings, source.extent);
    std::vector<pictures::MapLayer> layers;
    for (std::size_t k = 0; k < source.settings.layers.size(); ++k)
      layers.push_back(pictures::make_layer(bed, source.settings, source.extent, k));
    return layers;
  } catch (const Error&) {
    return {};
  }
}

}  // namespace

bool depends_on_extent(const pictures::MapLayers& layers) {
  return layers.size() > 1 && layers[1] == pictures::MapKind::displacement;
}

MapSource source_of(const pictures::PictureSeries& series, std::size_t k, std::shared_ptr<const Frame> frame,
                    std::shared_ptr<const Frame> reference) {
  const pictures::MapSettings& settings = series.plan.maps[0];
  const bool coloured = pictures::shows(settings.layers, pictures::MapKind::clusters);
  const std::size_t needed = coloured                                                    ? k + 1
                             : pictures::shows(settings.layers, pictures::MapKind::dyed) ? 1
                                                                                         : 0;
  const std::size_t colour_frames = std::min(series.seen_frames.instants.size(), needed);
  return {std::move(frame), std::move(reference), settings, series.extent, series.since, colour_frames};
}

render::FrameView draw_map(const pictures::PictureSeries& series, std::size_t k, const Frame& frame,
                           const Frame* reference) {
  return drawn_or_outlined(series, frame, [&] { return pictures::picture(series, k, frame, reference, 0); });
}

render::FrameView draw_change(const pictures::PictureSeries& series, const Frame& frame,
                              const Frame* reference) {
  const pictures::MapFrame bed{{frame, series.run.statics}, reference, false};
  return drawn_or_outlined(
      series, frame, [&] { return pictures::make_change_map(bed, series.plan.maps[0], series.extent); });
}

GrainValues grain_values(const MapSource& source, const RunStatics& statics) {
  for (const pictures::MapLayer& layer : layers_of(source, statics))
    if (!layer.values.empty()) return {layer.values, layer.legend.bars.at(0).title};
  return {};
}

render::FrameView shown_map(const render::FrameView& map, const pictures::MapExtent& part,
                            const BedFrame& bed) {
  render::FrameView view = pictures::empty_view(part);
  view.turn = map.turn;
  view.turn_max = map.turn_max;
  view.tilt = map.tilt;
  view.coloured = true;  // the same render target for everything shown
  view.transparent = map.transparent;
  add_grains(view, map);
  add_boundary(view, bed);
  return view;
}

}  // namespace talus::view
