#include "pictures/maps.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/core.h>
#include <tuple>
#include <utility>

#include "base/errors.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "pictures/bed_view.h"
#include "pictures/layers.h"
#include "pictures/scale.h"

namespace talus::pictures {
namespace {

/// Whether a layer fills the grains, rather than consisting of lines.
bool fills_grains(const MapLayers& layers, std::size_t k) {
  return layers[k] != MapKind::forces && layers[k] != MapKind::critical &&
         !(layers[k] == MapKind::displacement && k > 0);
}

bool has_bar(const MapLayers& layers, std::size_t k) {
  return fills_grains(layers, k) && is_scaled(layers[k]);
}

/// Returns the user's choice for the first layer with a bar; nothing for the other layer.
ScaleChoice choice_of(const MapSettings& settings, std::size_t k) {
  const bool first = has_bar(settings.layers, k) && (k == 0 || !has_bar(settings.layers, 0));
  return first ? ScaleChoice{settings.colours, settings.range_low, settings.range_high} : ScaleChoice{};
}

void check_theta_c(const MapSettings& settings) {
  const bool needed = any_layer(settings.layers, needs_theta_c);
  if (needed && !(settings.theta_c > radians(2.0) && settings.theta_c < radians(89.0)))
    throw Error(ExitCode::bad_data, "theta_c = {:.3f} deg: expected an angle of repose between 2 and 89 deg",
                degrees(settings.theta_c));
}

/// Adds grains with the looks of the lower layer that has any, otherwise as outlines; the looks of a second
/// layer are drawn as smaller discs inside.
void add_grains(render::FrameView& view, const BedFrame& bed,
                std::span<const std::vector<GrainStyle>> styles) {
  constexpr float inner_radius = 0.5f;  // fraction of the grain's radius
  const std::size_t count = bed.frame.x.size();
  view.discs.reserve(count * std::max<std::size_t>(1, styles.size()) + count / 16);
  const auto add = [&](Index i, const GrainStyle& style, float scale) {
    render::Disc disc = disc_of(bed, i);
    disc.radius *= scale;
    disc.fill = style.fill;
    disc.rim = style.rim;
    add_disc(view, disc, bed.statics);
  };
  for (Index i = 0; i < bed.statics.free_count; ++i) {
    const auto grain = static_cast<std::size_t>(i);
    add(i, styles.empty() ? outline_style() : styles[0][grain], 1.0f);
    if (styles.size() > 1 && styles[1][grain].marked) add(i, styles[1][grain], inner_radius);
  }
  for (Index i = bed.statics.free_count; i < bed.frame.grain_count(); ++i)
    add_disc(view, disc_of(bed, i), bed.statics);
}

/// Sets the symbol and unit of a bar, which are shown with the value of a grain.
void name_reading(MapKind kind, const analysis::GrainSource& bed, render::Bar& bar) {
  std::tie(bar.symbol, bar.unit) = map_reading(kind, bed.statics);
  if (!needs_reference(kind)) return;
  bar.unit += motion_span(bed).unit;
  if (bar.unit.starts_with(' ')) bar.unit.erase(0, 1);
}

/// Returns "Overloaded grains, p_o = 0.300; force chains".
std::string joint_title(std::span<const MapLayer> layers) {
  std::string title = layers[0].title;
  for (const MapLayer& layer : layers.subspan(1)) {
    title.append("; ").append(layer.title);
    char& first = title[title.size() - layer.title.size()];
    first = static_cast<char>(std::tolower(static_cast<unsigned char>(first)));
  }
  return title;
}

}  // namespace

render::Colour colour_over(const MapSettings& settings, std::size_t k) {
  const MapKind kind = settings.layers[k];
  const render::ColourMap own = is_signed(kind) ? render::ColourMap::diverging : render::ColourMap::gray;
  const render::ColourMap colours = choice_of(settings, k).colours.value_or(own);
  const bool has_hues = k == 0 && settings.own ? settings.own->kind == OwnQuantity::Kind::cluster
                                               : kind == MapKind::clusters || kind == MapKind::rigid;
  const bool light = has_hues || render::one_way(colours) == render::ColourMap::diverging;
  return light ? render::black : render::Colour{255, 60, 130};
}

namespace {

/// Returns the layer without borders of its lines; `spacing` of arrows, m.
MapLayer bare_layer(const analysis::GrainSource& bed, const MapSettings& settings, double spacing,
                    std::size_t k, const SeenFrames* seen) {
  const ScaleChoice choice = choice_of(settings, k);
  const bool over_grains = settings.layers.size() > 1 && fills_grains(settings.layers, 1 - k);
  const OverColour over = over_grains ? OverColour(colour_over(settings, 1 - k)) : OverColour();
  switch (settings.layers[k]) {
    case MapKind::gamma:
      return gamma_layer(bed, settings, choice);
    case MapKind::overloaded:
      return overloaded_layer(bed, settings, over_grains && k == 1);
    case MapKind::clusters:
      return clusters_layer(bed, settings, over_grains && k == 1, seen);
    case MapKind::coarse:
      return coarse_layer(bed, settings, choice);
    case MapKind::forces:
      return forces_layer(bed, over);
    case MapKind::critical:
      return critical_layer(bed, over);
    case MapKind::coordination:
      return coordination_layer(bed, choice);
    case MapKind::rigid:
      return rigid_layer(bed, over_grains && k == 1);
    case MapKind::size:
      return size_layer(bed, choice);
    case MapKind::dyed:
      return dyed_layer(bed, choice, seen);
    case MapKind::displacement:
      if (k > 0) return displacement_arrows(bed, settings.motion, over, spacing);
      [[fallthrough]];
    default:
      return value_layer(settings.layers[k], bed, settings, choice);
  }
}

}  // namespace

void add_borders(std::vector<render::Line>& lines, double border) {
  std::vector<render::Line> borders, above;
  for (const render::Line& line : lines) {
    if (line.colour.alpha < 255) continue;
    above.push_back(line);
    borders.push_back(line);
    borders.back().half_width += static_cast<float>(border);
    borders.back().colour = render::white;
  }
  std::erase_if(lines, [](const render::Line& line) { return line.colour.alpha == 255; });
  lines.insert(lines.end(), borders.begin(), borders.end());
  lines.insert(lines.end(), above.begin(), above.end());
}

MapLayer make_layer(const analysis::GrainSource& bed, const MapSettings& settings, const MapExtent& extent,
                    std::size_t k, const SeenFrames* seen) {
  constexpr double arrows_across = 60.0;  // upper limit that keeps arrows distinguishable
  const double spacing = (extent.x_max - extent.x_min) / arrows_across, diameter = bed.statics.mean_diameter;
  MapLayer layer = bare_layer(bed, settings, spacing, k, seen);
  const bool over_grains = settings.layers.size() > 1 && fills_grains(settings.layers, 1 - k);
  const bool has_arrows = settings.layers[k] == MapKind::displacement;
  if (over_grains)
    add_borders(layer.lines, line_border * (has_arrows ? std::max(spacing, diameter) : diameter));
  return layer;
}

std::string caption_of(const Frame& frame, const MapSettings& settings) {
  std::string caption = fmt::format("θ = {}°", degrees_text(frame.tilt, 2));
  if (std::isfinite(settings.theta_c) && settings.theta_c > 0.0) {
    caption += fmt::format(", θ_c = {:.2f}°", degrees(settings.theta_c));
    if (settings.theta_c_assumed) caption += " (assumed)";
  }
  return caption;
}

MapLayer scaled_layer(const std::string& title, const Scale& scale, std::vector<double> values,
                      render::Bar bar, bool outlines) {
  bar.values = values;
  return {title, grain_styles(scale, values, outlines), {}, {{std::move(bar)}, {}}, std::move(values), scale};
}

MapExtent bed_extent(const RunStatics& statics) { return {0.0, statics.length, 0.0, 0.0}; }

void extend(MapExtent& extent, const BedFrame& bed) {
  for (std::size_t i = 0; i < bed.frame.y.size(); ++i) {
    extent.y_min = std::min(extent.y_min, bed.frame.y[i] - bed.statics.radius[i]);
    extent.y_max = std::max(extent.y_max, bed.frame.y[i] + bed.statics.radius[i]);
  }
}

void extend(MapExtent& extent, const MapExtent& other) {
  extent.y_min = std::min(extent.y_min, other.y_min);
  extent.y_max = std::max(extent.y_max, other.y_max);
}

render::FrameView outlined_bed(const BedFrame& bed, const MapExtent& extent) {
  render::FrameView view = empty_view(extent);
  add_grains(view, bed, {});
  return view;
}

void print_letters(render::FrameView& view, double width, double points) {
  constexpr double points_per_cm = 72.0 / 2.54, smallest = 7.0 / 8.0;
  view.letters = width * points_per_cm / points;
  view.max_letters = view.letters / smallest;
}

std::string name_of(const MapSettings& map) {
  if (!map.own) return layers_name(map.layers);
  return map.own->name + (map.layers.size() > 1 ? "+" + layers_name({map.layers[1]}) : "");
}

bool has_palette(const MapSettings& map) {
  return shows(map.layers, MapKind::clusters) || (map.own && map.own->kind == OwnQuantity::Kind::cluster);
}

bool has_bar(const MapLayers& layers) {
  return has_bar(layers, 0) || (layers.size() > 1 && has_bar(layers, 1));
}

render::FrameView make_map(const analysis::GrainSource& frame, const MapSettings& settings,
                           const MapExtent& extent, const SeenFrames* seen) {
  check_theta_c(settings);
  std::vector<MapLayer> layers;
  for (std::size_t k = 0; k < settings.layers.size(); ++k) {
    if (k == 0 && settings.own) {
      layers.push_back(own_layer(frame, settings));
      continue;
    }
    layers.push_back(make_layer(frame, settings, extent, k, seen));
    for (render::Bar& bar : layers.back().legend.bars) name_reading(settings.layers[k], frame, bar);
  }
  return compose_map(frame, settings, extent, std::move(layers));
}

render::FrameView compose_map(const analysis::GrainSource& frame, const MapSettings& settings,
                              const MapExtent& extent, std::vector<MapLayer> layers) {
  std::vector<std::vector<GrainStyle>> styles;
  for (MapLayer& layer : layers)
    if (!layer.styles.empty()) styles.push_back(std::move(layer.styles));
  render::FrameView view = empty_view(extent);
  add_grains(view, frame, styles);
  for (const MapLayer& layer : layers)
    for (const render::Line& line : layer.lines) add_line(view, line, frame.statics);
  add_surroundings(view, frame);
  view.furniture = settings.furniture;
  view.transparent = settings.transparent;
  if (settings.printed > 0.0) print_letters(view, settings.printed, settings.points);
  // Even if no cluster has a colour yet: all frames of a movie have the same number of channels.
  view.coloured = has_palette(settings) || (shows(settings.layers, MapKind::rigid) && !settings.own);
  view.tilt = frame.frame.tilt;
  if (settings.turned) {
    view.turn = std::max(0.0, frame.frame.tilt);
    view.turn_max = std::max(view.turn, settings.tilt_max);
  }
  view.title = joint_title(layers);
  view.caption = caption_of(frame.frame, settings);
  for (MapLayer& layer : layers) view.legends.push_back(std::move(layer.legend));
  return view;
}

}  // namespace talus::pictures
