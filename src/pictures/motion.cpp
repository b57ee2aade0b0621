#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <set>
#include <utility>

#include "base/text.h"
#include "core/trigonometry.h"
#include "pictures/layers.h"
#include "pictures/scale.h"

namespace talus::pictures {
namespace {

/// Rounds to two digits, as printed in bars and legends.
double rounded(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::round(value / unit) * unit;
}

/// Returns nothing if nothing has moved. The lowest grains hardly move, so the scale covers at most five
/// decades; it is a valid range even if all move alike.
std::optional<ScaleRange> size_range(const LogHistogram& moved) {
  constexpr double most = 1e5, least = 2.0;  // ratio of the upper end to the lower one
  const double high = moved.quantile(size_shares.high);
  if (!(high > 0.0)) return std::nullopt;
  const double low = std::clamp(moved.quantile(size_shares.low), high / most, high / least);
  return ScaleRange{rounded(low), rounded(high)};
}

std::optional<ScaleRange> signed_range(const LogHistogram& turned) {
  const double largest = turned.quantile(signed_share);
  if (!(largest > 0.0)) return std::nullopt;
  return ScaleRange{-rounded(largest), rounded(largest)};
}

}  // namespace

MotionSpan motion_span(const analysis::GrainSource& bed) {
  const double begin = bed.earlier != nullptr ? bed.earlier->tilt : bed.frame.tilt;
  const double tilted = degrees(bed.frame.tilt - begin);
  // During the flow after failure the bed is not tilted, so there is nothing to divide by.
  const bool moved = bed.earlier != nullptr && bed.earlier->step != bed.frame.step;
  if (bed.per_degree && (tilted > 0.0 || !moved))
    return {true, tilted > 0.0 ? tilted : 1.0, " per degree of tilt", " per degree"};
  return {false, 1.0, fmt::format(" since {}°", degrees_text(begin, 2)), ""};
}

void LogHistogram::add(double value) {
  const double at =
      value >= smallest_ ? 1.0 + std::floor(classes_per_decade * std::log10(value / smallest_)) : 0.0;
  ++counts_[static_cast<std::size_t>(std::min(at, static_cast<double>(counts_.size() - 1)))];
  ++total_;
}

double LogHistogram::quantile(double share) const {
  const double wanted = share * static_cast<double>(total_);
  std::int64_t below = counts_[0];
  std::size_t k = 0;
  while (k + 1 < counts_.size() && static_cast<double>(below) < wanted) below += counts_[++k];
  if (k == 0) return 0.0;
  return smallest_ * std::pow(10.0, static_cast<double>(k) / classes_per_decade);
}

MotionSample::MotionSample(const MapLayers& maps, const MapSettings& settings) : settings_(settings) {
  constexpr double smallest_temperature = 1e-18;  // square of the smallest speed
  for (const MapKind kind : maps) {
    const LogHistogram none =
        kind == MapKind::temperature ? LogHistogram(smallest_temperature) : LogHistogram();
    sizes_.try_emplace(kind, std::array{none, none});
  }
}

void MotionSample::add(const analysis::GrainSource& bed) {
  const MotionSpan span = motion_span(bed);
  for (auto& [kind, sizes] : sizes_) {
    const bool moving = needs_reference(kind);
    if (moving && bed.earlier == nullptr) continue;
    for (const double value : map_values(kind, bed, settings_))
      if (!std::isnan(value)) sizes[moving && span.per_degree].add(std::abs(value));
  }
}

MotionRanges MotionSample::ranges() const {
  MotionRanges ranges;
  for (const auto& [kind, sizes] : sizes_)
    for (std::size_t per_degree = 0; per_degree < sizes.size(); ++per_degree)
      ranges.fitting[kind][per_degree] =
          is_signed(kind) ? signed_range(sizes[per_degree]) : size_range(sizes[per_degree]);
  return ranges;
}

namespace {

/// Returns all free grains or, if `spacing` exceeds D, the first in each square of that side.
std::vector<Index> evenly_spread(const analysis::GrainSource& bed, double spacing) {
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
    lines.push_back(line_between(x0, y0, x1, y1, half_width, colour));
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
double largest_displacement(const analysis::GrainSource& bed, const MotionRanges& motion,
                            const MotionSpan& span) {
  if (const auto range = motion.range(MapKind::displacement, span.per_degree)) return range->high;
  MotionSample sample({MapKind::displacement});
  sample.add(bed);
  const auto own = sample.ranges().range(MapKind::displacement, span.per_degree);
  return own.value_or(fixed_motion_range(MapKind::displacement, span.per_degree)).high;
}

}  // namespace

MapLayer displacement_arrows(const analysis::GrainSource& bed, const MotionRanges& motion,
                             const OverColour& over, double spacing) {
  constexpr double longest = 1.6, cut = 2.0, shortest = 0.2, half_width = 0.04;  // D, or spacing
  const render::Colour colour = over.value_or(render::Colour{0, 90, 180});
  const MotionSpan span = motion_span(bed);
  const double diameter = bed.statics.mean_diameter, unit = std::max(spacing, diameter);
  const double times = magnification(largest_displacement(bed, motion, span), longest * unit / diameter);
  MapLayer layer;
  layer.title = "Displacement" + span.title;
  for (const Index i : evenly_spread(bed, spacing)) {
    const Vec2 moved = bed.earlier != nullptr ? displacement(bed, *bed.earlier, i) : Vec2{};
    const double distance = std::hypot(moved.x, moved.y);
    const double length = std::min(times * distance / span.degrees, cut * unit);
    if (!(length > shortest * unit)) continue;
    const double stretch = length / distance;
    add_arrow(layer.lines, bed.frame.x[i], bed.frame.y[i], {stretch * moved.x, stretch * moved.y},
              half_width * unit, colour);
  }
  const std::string label = fmt::format("arrow = {:.6g} × displacement{}, at most {:.2g} D", times, span.unit,
                                        cut * unit / diameter);
  layer.legend.swatches = {line_swatch(colour, 0.15, label)};
  return layer;
}

}  // namespace talus::pictures
