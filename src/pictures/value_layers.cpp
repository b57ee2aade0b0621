/// Maps of a quantity of grains, drawn by the rule in its table row.

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "base/errors.h"
#include "pictures/layers.h"
#include "pictures/motion.h"
#include "pictures/texts.h"

namespace talus::pictures {
namespace {

const analysis::FrameQuantity& quantity_of(MapKind kind) {
  const analysis::FrameQuantity* quantity = shown_quantity(kind);
  if (quantity == nullptr) throw Error(ExitCode::internal, "a map that shows no number for each grain");
  return *quantity;
}

Scale scale_of(MapKind kind, const MapFrame& bed, const MapSettings& settings, bool per_degree) {
  constexpr int max_ticks = 4;
  const analysis::ScaleRule rule = quantity_of(kind).map.scale;
  ScaleRange range = fixed_motion_range(kind, per_degree);
  if (fits_frames(kind)) range = settings.motion.range(kind, per_degree).value_or(range);
  if (rule == analysis::ScaleRule::by_depth) {
    const double largest = range.high * std::max(1.0, bed.statics.depth / bed.statics.mean_diameter);
    const double step = round_step(largest, max_ticks);
    range.high = std::ceil(largest / step) * step;
  }
  return {rule == analysis::ScaleRule::about_zero ? render::ColourMap::diverging : render::ColourMap::viridis,
          range.low, range.high, rule == analysis::ScaleRule::sizes};
}

/// Returns ", 5 to 99 % of grains" if the range is fitted; empty if it is fixed or chosen.
std::string fitted_text(MapKind kind, const MotionRanges& motion, bool per_degree,
                        const ScaleChoice& choice) {
  if (choice.low || !fits_frames(kind) || !motion.range(kind, per_degree)) return "";
  if (is_signed(kind)) return fmt::format(", {:.6g} % of grains", 100.0 * signed_share);
  return fmt::format(", {:.6g} to {:.6g} % of grains", 100.0 * size_shares.low, 100.0 * size_shares.high);
}

}  // namespace

ScaleRange fixed_motion_range(MapKind kind, bool per_degree) {
  const analysis::MapRule& rule = quantity_of(kind).map;
  return per_degree ? ScaleRange{rule.low_per_degree, rule.high_per_degree} : ScaleRange{rule.low, rule.high};
}

std::vector<double> map_values(MapKind kind, const MapFrame& bed, const MapSettings& settings) {
  const analysis::FrameQuantity& quantity = quantity_of(kind);
  analysis::GrainSource source = {bed};
  source.earlier = bed.reference;
  if (needs_reference(kind)) source.degrees = motion_span(bed).degrees;
  if (is_coarse(kind)) source.length = coarse_length(bed, settings);
  const double unit = analysis::bed_unit(quantity.unit, bed.statics).value;
  std::vector<double> values = quantity.values(source, 0);
  values.resize(static_cast<std::size_t>(bed.statics.free_count));
  for (double& value : values) value /= unit;
  return values;
}

MapLayer value_layer(MapKind kind, const MapFrame& bed, const MapSettings& settings,
                     const ScaleChoice& choice) {
  const analysis::MapRule& rule = quantity_of(kind).map;
  const MotionSpan span = needs_reference(kind) ? motion_span(bed) : MotionSpan{};
  const Scale scale = chosen(scale_of(kind, bed, settings, span.per_degree), choice);
  const std::string averaged =
      is_coarse(kind) ? fmt::format(", coarse-grained over {:.6g} D", settings.length) : std::string();
  const render::Bar bar =
      bar_of(scale, fmt::format("{}{}{}{}", rule.bar, span.unit, rule.sign,
                                fitted_text(kind, settings.motion, span.per_degree, choice)));
  MapLayer layer = (rule.outlines ? scaled_layer_with_outlines : scaled_layer)(
      fmt::format("{}{}{}", rule.title, span.title, averaged), scale, map_values(kind, bed, settings), bar);
  const GrainStyle open = outline_style();
  if (!rule.without.empty())
    layer.legend.swatches = {
        {render::Swatch::Kind::disc, open.fill, open.rim, 0.0, std::string(rule.without)}};
  return layer;
}

}  // namespace talus::pictures
