#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <utility>

#include "pictures/layers.h"
#include "pictures/texts.h"

namespace talus::pictures {
namespace {

constexpr int dyed_layers = 8;
constexpr double dyed_column = 10.0;  // D, approximate
constexpr double second_shade = 0.7;  // factor for the channels of every second column

render::Colour shaded(const render::Colour& colour) {
  const auto channel = [](std::uint8_t full) { return static_cast<std::uint8_t>(second_shade * full); };
  return {channel(colour.red), channel(colour.green), channel(colour.blue), colour.alpha};
}

/// Returns the middle, as a fraction of the scale, of the layer in which a fraction lies.
double layer_share(double share) {
  return (std::clamp(std::floor(share * dyed_layers), 0.0, dyed_layers - 1.0) + 0.5) / dyed_layers;
}

/// Whether a position lies in a column of the second shade. The number of columns is even, also around the
/// period.
bool in_second_column(double x, double length, double diameter) {
  const double pairs = std::max(1.0, std::round(length / (2.0 * dyed_column * diameter)));
  return static_cast<long>(std::floor(2.0 * pairs * x / length)) % 2 != 0;
}

}  // namespace

MapLayer size_layer(const MapFrame& bed, const ScaleChoice& choice) {
  constexpr double alike = 0.05;  // fraction of D: range of sizes that count as equal
  const RunStatics& statics = bed.statics;
  std::vector<double> sizes;
  for (Index i = 0; i < statics.free_count; ++i)
    sizes.push_back(2.0 * statics.radius[i] / statics.mean_diameter);
  double low = 1.0, high = 1.0;
  if (!sizes.empty()) {
    low = std::ranges::min(sizes);
    high = std::ranges::max(sizes);
  }
  if (high - low < alike) {
    low -= alike;
    high += alike;
  }
  const Scale scale = chosen({render::ColourMap::viridis, low, high}, choice);
  return scaled_layer("Size of grains", scale, std::move(sizes), bar_of(scale, "diameter in D"));
}

MapLayer dyed_layer(const MapFrame& bed, const ScaleChoice& choice) {
  constexpr int max_steps = 8;
  const RunStatics& statics = bed.statics;
  const double diameter = statics.mean_diameter;
  const auto begin = [&](Index i) {
    const auto grain = static_cast<std::size_t>(i);
    return grain < bed.dyed_at.size() ? bed.dyed_at[grain] : Vec2{bed.frame.x[grain], bed.frame.y[grain]};
  };
  double highest = diameter;
  for (Index i = 0; i < statics.free_count; ++i) highest = std::max(highest, begin(i).y);
  const Scale scale = chosen({render::ColourMap::viridis, 0.0, highest / diameter}, choice);
  MapLayer layer;
  std::vector<double> heights;
  layer.title = "Layers and columns of the bed as the tilt began";
  for (Index i = 0; i < statics.free_count; ++i) {
    const Vec2 at = begin(i);
    const render::Colour light =
        render::colour_at(scale.colours, layer_share(share_of(scale, at.y / diameter)));
    const render::Colour fill = in_second_column(at.x, statics.length, diameter) ? shaded(light) : light;
    layer.styles.push_back({fill, rim_of(fill)});
    heights.push_back(at.y / diameter);
  }
  render::Bar bar{"height above the floor at that time, in D", {}, {}, scale.low, scale.high};
  const std::size_t colours = render::colour_ramp(scale.colours).size();
  for (std::size_t k = 0; k < colours; ++k)
    bar.colours.push_back(render::colour_at(
        scale.colours, layer_share((static_cast<double>(k) + 0.5) / static_cast<double>(colours))));
  for (const RoundTick& tick : round_ticks(scale.low, scale.high, max_steps))
    bar.ticks.push_back({std::clamp(share_of(scale, tick.value), 0.0, 1.0), tick.label});
  bar.values = std::move(heights);
  layer.legend.bars = {bar};
  return layer;
}

}  // namespace talus::pictures
