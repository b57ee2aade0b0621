#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>

#include "analysis/coarse_fields.h"
#include "analysis/local_solid_fraction.h"
#include "core/errors.h"
#include "core/trigonometry.h"
#include "pictures/layers.h"
#include "pictures/texts.h"

namespace talus {
namespace {

/// The mass of a grain over its area, kg/m^2; all are of one material.
double material_density(const RunStatics& statics) {
  return statics.mass[0] / (pi * statics.radius[0] * statics.radius[0]);
}

double solid_fraction(const CoarseField& field, const RunStatics& statics) {
  return field.density / material_density(statics);
}

double pressure(const CoarseField& field, const RunStatics& statics) {
  const Tensor2 stress = field.stress();
  return (stress.xx + stress.yy) / (material_density(statics) * statics.gravity * statics.mean_diameter);
}

double dimensionless_shear_rate(const CoarseField& field, const RunStatics& statics) {
  return shear_rate(field.velocity_gradient) * std::sqrt(statics.mean_diameter / statics.gravity);
}

/// A map of a coarse-grained field. Without ends the scale goes by the depth of the bed.
struct FieldMap {
  MapKind kind;
  std::string_view title, bar;
  double low, high;
  bool logarithmic;
  double (*value)(const CoarseField& field, const RunStatics& statics);  ///< null: temperatures
};

constexpr std::array<FieldMap, 4> field_maps = {{
    {MapKind::density, "Solid fraction", "area of grains over area", 0.7, 0.9, false, solid_fraction},
    {MapKind::stress, "Pressure", "P = σ_1 + σ_2 in ρgD", not_known, not_known, false, pressure},
    {MapKind::shear_rate, "Shear rate", "in √(g/D)", 1e-6, 0.1, true, dimensionless_shear_rate},
    {MapKind::temperature, "Granular temperature", "in gD", 1e-10, 1e-2, true, nullptr},
}};

/// Below a depth H of grains P is about 1.5 rho g H on the average, and more where forces concentrate.
double largest_pressure(const RunStatics& statics) {
  constexpr int most_ticks = 4;
  const double largest = 2.0 * std::max(1.0, statics.depth / statics.mean_diameter);
  const double step = round_step(largest, most_ticks);
  return std::ceil(largest / step) * step;
}

std::vector<double> values_of(const FieldMap& map, const MapFrame& of, double cutoff) {
  std::vector<double> values;
  if (map.value == nullptr) {
    values = granular_temperatures(of, cutoff);
    for (double& value : values) value /= of.statics.gravity * of.statics.mean_diameter;
    return values;
  }
  const CoarseFields fields(of, cutoff);
  for (Index i = 0; i < of.statics.free_count; ++i)
    values.push_back(map.value(fields.at(of.frame.x[i], of.frame.y[i]), of.statics));
  return values;
}

}  // namespace

MapLayer cells_layer(const MapFrame& of, const ScaleChoice& choice) {
  const Scale scale = chosen({ColourMap::viridis, 0.65, 0.95}, choice);
  const std::vector<double> values = local_solid_fractions(of);
  const Bar bar = bar_of(scale, "area of a grain over that of its cell");
  MapLayer layer{
      "Local solid fraction", looks_or_outlines(scale, values), {}, {{measuring(bar, values)}, {}}};
  const GrainLook open = outline_look();
  layer.legend.swatches = {{Swatch::Kind::disc, open.fill, open.rim, 0.0, "at the surface"}};
  return layer;
}

MapLayer field_layer(MapKind kind, const MapFrame& of, const MapSettings& settings,
                     const ScaleChoice& choice) {
  const FieldMap& map = *std::ranges::find(field_maps, kind, &FieldMap::kind);
  const double cutoff = 0.5 * coarse_length(of, settings);
  const bool by_depth = std::isnan(map.high);
  const Scale scale = chosen({ColourMap::viridis, by_depth ? 0.0 : map.low,
                              by_depth ? largest_pressure(of.statics) : map.high, map.logarithmic},
                             choice);
  const std::vector<double> values = values_of(map, of, cutoff);
  return {fmt::format("{}, coarse-grained over {:.6g} D", map.title, settings.length),
          looks_or_outlines(scale, values),
          {},
          {{measuring(bar_of(scale, std::string(map.bar)), values)}, {}}};
}

}  // namespace talus
