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

/// A map of a coarse-grained field. Without ends the scale goes by the depth of the bed, or by the frames
/// that are drawn (fits_frames).
struct FieldMap {
  MapKind kind;
  std::string_view title, bar;
  double low, high;
  double (*value)(const CoarseField& field, const RunStatics& statics);  ///< null: temperatures
};

constexpr std::array<FieldMap, 4> field_maps = {{
    {MapKind::density, "Solid fraction", "area of grains over area", 0.7, 0.9, solid_fraction},
    {MapKind::stress, "Pressure", "P = σ_1 + σ_2 in ρgD", not_known, not_known, pressure},
    {MapKind::shear_rate, "Shear rate", "in √(g/D)", not_known, not_known, dimensionless_shear_rate},
    {MapKind::temperature, "Granular temperature", "in gD", not_known, not_known, nullptr},
}};

const FieldMap& field_map(MapKind kind) {
  const auto* const found = std::ranges::find(field_maps, kind, &FieldMap::kind);
  if (found == field_maps.end()) throw Error(ExitCode::internal, "a map that shows no field");
  return *found;
}

/// Below a depth H of grains P is about 1.5 rho g H on the average, and more where forces concentrate.
double largest_pressure(const RunStatics& statics) {
  constexpr int most_ticks = 4;
  const double largest = 2.0 * std::max(1.0, statics.depth / statics.mean_diameter);
  const double step = round_step(largest, most_ticks);
  return std::ceil(largest / step) * step;
}

std::vector<double> values_of(const FieldMap& map, const MapFrame& of, const MapSettings& settings) {
  const double cutoff = 0.5 * coarse_length(of, settings);
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

/// In sqrt(g D).
std::vector<double> speeds(const MapFrame& of) {
  const double unit = std::sqrt(of.statics.gravity * of.statics.mean_diameter);
  std::vector<double> values;
  for (Index i = 0; i < of.statics.free_count; ++i)
    values.push_back(std::hypot(of.frame.vx[i], of.frame.vy[i]) / unit);
  return values;
}

Scale velocity_scale(MapKind kind, const MapSettings& settings, const ScaleChoice& choice) {
  const ScaleRange range = motion_range(kind, settings.motion, false);
  return chosen({ColourMap::viridis, range.low, range.high, true}, choice);
}

Scale field_scale(const FieldMap& map, const MapFrame& of, const MapSettings& settings,
                  const ScaleChoice& choice) {
  if (fits_frames(map.kind)) return velocity_scale(map.kind, settings, choice);
  const bool by_depth = std::isnan(map.high);
  return chosen(
      {ColourMap::viridis, by_depth ? 0.0 : map.low, by_depth ? largest_pressure(of.statics) : map.high},
      choice);
}

}  // namespace

std::vector<double> velocity_values(MapKind kind, const MapFrame& of, const MapSettings& settings) {
  return kind == MapKind::speed ? speeds(of) : values_of(field_map(kind), of, settings);
}

MapLayer speed_layer(const MapFrame& of, const MapSettings& settings, const ScaleChoice& choice) {
  const Scale scale = velocity_scale(MapKind::speed, settings, choice);
  return scaled_layer(
      "Speed of grains", scale, speeds(of),
      bar_of(scale, "in √(gD)" + fitted_text(MapKind::speed, settings.motion, false, choice)));
}

MapLayer cells_layer(const MapFrame& of, const ScaleChoice& choice) {
  const Scale scale = chosen({ColourMap::viridis, 0.65, 0.95}, choice);
  MapLayer layer = scaled_layer_with_outlines("Local solid fraction", scale, local_solid_fractions(of),
                                              bar_of(scale, "area of a grain over that of its cell"));
  const GrainLook open = outline_look();
  layer.legend.swatches = {{Swatch::Kind::disc, open.fill, open.rim, 0.0, "at the surface"}};
  return layer;
}

MapLayer field_layer(MapKind kind, const MapFrame& of, const MapSettings& settings,
                     const ScaleChoice& choice) {
  const FieldMap& map = field_map(kind);
  const Scale scale = field_scale(map, of, settings, choice);
  const std::string fitted = fits_frames(kind) ? fitted_text(kind, settings.motion, false, choice) : "";
  return scaled_layer_with_outlines(
      fmt::format("{}, coarse-grained over {:.6g} D", map.title, settings.length), scale,
      values_of(map, of, settings), bar_of(scale, std::string(map.bar) + fitted));
}

}  // namespace talus
