#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <set>
#include <utility>

#include "pictures/layers.h"
#include "pictures/motion.h"
#include "pictures/texts.h"

namespace talus::pictures {
namespace {

/// Returns all free grains or, if `spacing` exceeds D, the one with the smallest id in each square of that
/// side.
std::vector<Index> evenly_spread(const MapFrame& bed, double spacing) {
  std::vector<Index> grains;
  std::set<std::pair<long, long>> taken;
  const bool all = spacing <= bed.statics.mean_diameter;
  const auto is_first_of_square = [&](Index i) {
    return taken.emplace(std::lround(bed.frame.x[i] / spacing), std::lround(bed.frame.y[i] / spacing)).second;
  };
  for (Index i = 0; i < bed.statics.free_count; ++i)
    if (all || is_first_of_square(i)) grains.push_back(i);
  return grains;
}

void add_arrow(std::vector<render::Line>& lines, double x, double y, Vec2 along, double half_width,
               const render::Colour& colour) {
  const auto line = [&](double x0, double y0, double x1, double y1) {
    lines.push_back({static_cast<float>(x0), static_cast<float>(y0), static_cast<float>(x1),
                     static_cast<float>(y1), static_cast<float>(half_width), colour});
  };
  const double tip_x = x + along.x, tip_y = y + along.y;
  line(x, y, tip_x, tip_y);
  constexpr double back = 0.35, aside = 0.2;  // fractions of its length
  line(tip_x, tip_y, tip_x - back * along.x - aside * along.y, tip_y - back * along.y + aside * along.x);
  line(tip_x, tip_y, tip_x - back * along.x + aside * along.y, tip_y - back * along.y - aside * along.x);
}

/// Returns the factor by which displacements are magnified: 1, 2 or 5 times a power of ten, such that `high`
/// becomes at most `longest` long.
double magnification(double high, double longest) {
  const double exact = longest / high;
  const double decade = std::pow(10.0, std::floor(std::log10(exact)));
  for (const double digit : {5.0, 2.0})
    if (digit * decade <= exact) return digit * decade;
  return decade;
}

/// Returns a displacement, in D, per degree if the span is, that exceeds 99 % of those in the frames that are
/// drawn or, if these are unknown, in this frame.
double largest_displacement(const MapFrame& bed, const MotionRanges& motion, const MotionSpan& span) {
  if (const auto range = motion.range(MapKind::displacement, span.per_degree)) return range->high;
  MotionSample sample({MapKind::displacement});
  sample.add(bed);
  const auto own = sample.ranges().range(MapKind::displacement, span.per_degree);
  return own.value_or(fixed_motion_range(MapKind::displacement, span.per_degree)).high;
}

}  // namespace

MapLayer displacement_arrows(const MapFrame& bed, const MotionRanges& motion, const OverColour& over,
                             double spacing) {
  constexpr double longest = 1.6, cut = 2.0, shortest = 0.2, half_width = 0.04;  // D, or spacing
  const render::Colour colour = over.value_or(render::Colour{0, 90, 180});
  const MotionSpan span = motion_span(bed);
  const double diameter = bed.statics.mean_diameter, unit = std::max(spacing, diameter);
  const double times = magnification(largest_displacement(bed, motion, span), longest * unit / diameter);
  MapLayer layer;
  layer.title = "Displacement" + span.title;
  for (const Index i : evenly_spread(bed, spacing)) {
    const Vec2 moved = bed.reference != nullptr ? displacement(bed, *bed.reference, i) : Vec2{};
    const double distance = std::hypot(moved.x, moved.y);
    const double length = std::min(times * distance / span.degrees, cut * unit);
    if (!(length > shortest * unit)) continue;
    const double stretch = length / distance;
    add_arrow(layer.lines, bed.frame.x[i], bed.frame.y[i], {stretch * moved.x, stretch * moved.y},
              half_width * unit, colour);
  }
  const std::string label = fmt::format("arrow = {:.6g} × displacement{}, at most {:.2g} D", times, span.unit,
                                        cut * unit / diameter);
  layer.legend.swatches = {{render::Swatch::Kind::line, colour, colour, 0.15, label}};
  return layer;
}

}  // namespace talus::pictures
