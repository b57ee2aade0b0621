#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/trigonometry.h"
#include "maps/layers.h"
#include "maps/texts.h"

namespace talus {
namespace {

/// What displacements and rotations are measured over.
struct Span {
  bool per_degree = false;
  double degrees = 1.0;  ///< what they are divided by
  std::string title;     ///< " since 5.00°"
  std::string unit;      ///< " per degree"
};

Span span_of(const MapFrame& of) {
  const double begin = of.reference != nullptr ? of.reference->tilt : of.frame.tilt;
  const double tilted = degrees(of.frame.tilt - begin);
  // Where the bed flows after failure it is not tilted any more: there is nothing to divide by.
  const bool moved = of.reference != nullptr && of.reference->step != of.frame.step;
  if (of.per_degree && (tilted > 0.0 || !moved))
    return {true, tilted > 0.0 ? tilted : 1.0, " per degree of tilt", " per degree"};
  return {false, 1.0, " since " + fixed_text(degrees(begin), 2) + "°", ""};
}

/// In D, or D per degree, of each free grain.
std::vector<Vec2> displacements(const MapFrame& of, const Span& span) {
  const RunStatics& statics = of.statics;
  std::vector<Vec2> moved(static_cast<std::size_t>(statics.free_count));
  if (of.reference == nullptr) return moved;
  const Frame& before = *of.reference;
  const double unit = statics.mean_diameter * span.degrees;
  for (Index i = 0; i < statics.free_count; ++i) {
    const double periods = statics.periodic ? of.frame.image[i] - before.image[i] : 0;
    moved[i] = {(of.frame.x[i] - before.x[i] + periods * statics.length) / unit,
                (of.frame.y[i] - before.y[i]) / unit};
  }
  return moved;
}

/// From the creep of a bed at rest to an avalanche.
Scale displacement_scale(const Span& span, const ScaleChoice& choice) {
  return chosen({ColourMap::viridis, span.per_degree ? 1e-4 : 1e-3, 10.0, true}, choice);
}

/// All free grains; or, where `spacing` is more than D, that with the smallest id in each square of that
/// side.
std::vector<Index> evenly_spread(const MapFrame& of, double spacing) {
  std::vector<Index> grains;
  std::set<std::pair<long, long>> taken;
  const bool all = spacing <= of.statics.mean_diameter;
  const auto is_first_of_square = [&](Index i) {
    return taken.emplace(std::lround(of.frame.x[i] / spacing), std::lround(of.frame.y[i] / spacing)).second;
  };
  for (Index i = 0; i < of.statics.free_count; ++i)
    if (all || is_first_of_square(i)) grains.push_back(i);
  return grains;
}

void add_arrow(std::vector<Line>& lines, double x, double y, Vec2 along, double half_width,
               const Colour& colour) {
  const auto line = [&](double x0, double y0, double x1, double y1) {
    lines.push_back({static_cast<float>(x0), static_cast<float>(y0), static_cast<float>(x1),
                     static_cast<float>(y1), static_cast<float>(half_width), colour});
  };
  const double tip_x = x + along.x, tip_y = y + along.y;
  line(x, y, tip_x, tip_y);
  constexpr double back = 0.35, aside = 0.2;  // of its length
  line(tip_x, tip_y, tip_x - back * along.x - aside * along.y, tip_y - back * along.y + aside * along.x);
  line(tip_x, tip_y, tip_x - back * along.x + aside * along.y, tip_y - back * along.y - aside * along.x);
}

}  // namespace

MapLayer displacement_layer(const MapFrame& of, const ScaleChoice& choice) {
  const Span span = span_of(of);
  const Scale scale = displacement_scale(span, choice);
  std::vector<double> values;
  for (const Vec2& moved : displacements(of, span)) values.push_back(std::hypot(moved.x, moved.y));
  return {
      "Displacement" + span.title, looks_of(scale, values), {}, {{bar_of(scale, "in D" + span.unit)}, {}}};
}

MapLayer displacement_arrows(const MapFrame& of, const OverColour& over, double spacing) {
  constexpr double longest = 1.6, half_width = 0.04;  // D, or spacing
  const Colour colour = over.value_or(Colour{0, 90, 180});
  const Span span = span_of(of);
  const Scale scale = displacement_scale(span, {});
  const double unit = std::max(spacing, of.statics.mean_diameter);
  MapLayer layer;
  layer.title = "Displacement" + span.title;
  const std::vector<Vec2> moved = displacements(of, span);
  for (const Index i : evenly_spread(of, spacing)) {
    const double distance = std::hypot(moved[i].x, moved[i].y);
    if (!(distance > scale.low)) continue;
    const double stretch = longest * unit * std::min(1.0, share_of(scale, distance)) / distance;
    add_arrow(layer.lines, of.frame.x[i], of.frame.y[i], {stretch * moved[i].x, stretch * moved[i].y},
              half_width * unit, colour);
  }
  const std::string label = "length logarithmic, from " + brief_text(scale.low) + " to " +
                            brief_text(scale.high) + " D" + span.unit;
  layer.legend.swatches = {{Swatch::Kind::line, colour, colour, 0.15, label}};
  return layer;
}

MapLayer rotation_layer(const MapFrame& of, const ScaleChoice& choice) {
  const Span span = span_of(of);
  const double largest = span.per_degree ? 10.0 : 30.0;  // degrees
  const Scale scale = chosen({ColourMap::diverging, -largest, largest}, choice);
  std::vector<double> values(static_cast<std::size_t>(of.statics.free_count), 0.0);
  if (of.reference != nullptr)
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = degrees(of.frame.angle[i] - of.reference->angle[i]) / span.degrees;
  return {"Rotation" + span.title,
          looks_of(scale, values),
          {},
          {{bar_of(scale, "in °" + span.unit + ", counter-clockwise positive")}, {}}};
}

}  // namespace talus
