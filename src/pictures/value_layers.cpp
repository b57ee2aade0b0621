/// Maps that are a number of each grain and a rule of scale.

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>

#include "analysis/coarse_fields.h"
#include "analysis/contact_network.h"
#include "analysis/local_deformation.h"
#include "analysis/local_solid_fraction.h"
#include "core/errors.h"
#include "core/trigonometry.h"
#include "pictures/layers.h"
#include "pictures/motion.h"
#include "pictures/texts.h"

namespace talus {
namespace {

using Numbers = std::vector<double>;

enum class ScaleRule {
  fixed,       ///< from low to high
  by_depth,    ///< from 0 to the depth of the bed in D times high, rounded up
  sizes,       ///< logarithmic; of the frames that are drawn, or from low to high
  about_zero,  ///< to either side of 0; of the frames that are drawn, or up to high
};

struct ValueMap {
  MapKind kind;
  std::string_view title, bar, sign;  ///< "Rotation of grains", "in °", ", counter-clockwise positive"
  ScaleRule rule;
  std::array<ScaleRange, 2>
      ends;  ///< of the scale: in all, and per degree; alike where there is no reference
  Numbers (*values)(const MapFrame& of, const MapSettings& settings, const MotionSpan& span);
  /// Grains without a value show only where they are, and the legend says what they are.
  bool outlines = false;
  std::string_view without = {};
};

/// What `value` says of each free grain.
template <typename Value>
Numbers each(const MapFrame& of, const Value& value) {
  Numbers values;
  for (Index i = 0; i < of.statics.free_count; ++i) values.push_back(value(i));
  return values;
}

/// (s1 + s2) / (rho g D), the stress of a grain being its internal moment over its area, rho its mass over
/// its area.
Numbers pressures(const MapFrame& of, const MapSettings&, const MotionSpan&) {
  const RunStatics& statics = of.statics;
  return each(of, [&](Index i) {
    const double trace = of.frame.internal_moment[i].xx + of.frame.internal_moment[i].yy;
    return trace / (statics.mass[i] * statics.gravity * statics.mean_diameter);
  });
}

Numbers distances(const MapFrame& of, const MapSettings&, const MotionSpan& span) {
  Numbers values;
  for (const Vec2& moved : displacements(of, span)) values.push_back(std::hypot(moved.x, moved.y));
  return values;
}

/// In degrees.
Numbers turns(const MapFrame& of, const MapSettings&, const MotionSpan& span) {
  return each(of, [&](Index i) {
    return of.reference == nullptr ? 0.0 : degrees(of.frame.angle[i] - of.reference->angle[i]) / span.degrees;
  });
}

/// What `value` says of the neighbourhood of each grain, over `unit`; 0 without a reference.
template <typename Value>
Numbers of_neighbourhoods(const MapFrame& of, double unit, const Value& value) {
  Numbers values(static_cast<std::size_t>(of.statics.free_count), 0.0);
  if (of.reference == nullptr) return values;
  const std::vector<LocalDeformation> all = local_deformations(*of.reference, of);
  std::ranges::transform(all, values.begin(),
                         [&](const LocalDeformation& each) { return value(each) / unit; });
  return values;
}

Numbers nonaffine_displacements(const MapFrame& of, const MapSettings&, const MotionSpan& span) {
  return of_neighbourhoods(of, of.statics.mean_diameter * span.degrees,
                           [](const LocalDeformation& each) { return std::sqrt(each.nonaffine); });
}

template <double (*strain)(const Tensor2&)>
Numbers strains(const MapFrame& of, const MapSettings&, const MotionSpan& span) {
  return of_neighbourhoods(of, span.degrees,
                           [](const LocalDeformation& each) { return strain(each.gradient); });
}

Numbers speeds(const MapFrame& of, const MapSettings&, const MotionSpan&) {
  const double unit = std::sqrt(of.statics.gravity * of.statics.mean_diameter);
  return each(of, [&](Index i) { return std::hypot(of.frame.vx[i], of.frame.vy[i]) / unit; });
}

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

template <double (*value)(const CoarseField& field, const RunStatics& statics)>
Numbers coarse_values(const MapFrame& of, const MapSettings& settings, const MotionSpan&) {
  const CoarseFields fields(of, 0.5 * coarse_length(of, settings));
  return each(of, [&](Index i) { return value(fields.at(of.frame.x[i], of.frame.y[i]), of.statics); });
}

Numbers temperatures(const MapFrame& of, const MapSettings& settings, const MotionSpan&) {
  Numbers values = granular_temperatures(of, 0.5 * coarse_length(of, settings));
  for (double& value : values) value /= of.statics.gravity * of.statics.mean_diameter;
  return values;
}

Numbers mobilisations(const MapFrame& of, const MapSettings&, const MotionSpan&) {
  return mobilised_friction_of_grains(of);
}

Numbers cell_fractions(const MapFrame& of, const MapSettings&, const MotionSpan&) {
  return local_solid_fractions(of);
}

constexpr std::array<ScaleRange, 2> ends(double low, double high, double low_per_degree,
                                         double high_per_degree) {
  return {{{low, high}, {low_per_degree, high_per_degree}}};
}
constexpr std::array<ScaleRange, 2> ends(double low, double high) { return ends(low, high, low, high); }

// Below a depth H of grains their pressure is about 2 rho g H on the average, that of the bed about 1.5 rho g
// H, and more where forces concentrate.
constexpr auto value_maps = std::to_array<ValueMap>({
    {MapKind::pressure, "Pressure in each grain", "P = σ_1 + σ_2 in ρgD", "", ScaleRule::by_depth,
     ends(0.0, 3.0), pressures},
    {MapKind::displacement, "Displacement", "in D", "", ScaleRule::sizes, ends(1e-3, 10.0, 1e-4, 10.0),
     distances},
    {MapKind::rotation, "Rotation", "in °", ", counter-clockwise positive", ScaleRule::about_zero,
     ends(-30.0, 30.0, -10.0, 10.0), turns},
    {MapKind::speed, "Speed of grains", "in √(gD)", "", ScaleRule::sizes, ends(1e-5, 1.0), speeds},
    {MapKind::nonaffine, "Non-affine displacement", "D_m_i_n in D", "", ScaleRule::sizes,
     ends(1e-4, 1.0, 1e-5, 1.0), nonaffine_displacements},
    {MapKind::shear, "Shear strain", "s_1 − s_2 of neighbourhoods", "", ScaleRule::sizes,
     ends(1e-4, 1.0, 1e-5, 1.0), strains<shear_strain>},
    {MapKind::dilation, "Dilation", "ΔA/A of neighbourhoods", "", ScaleRule::about_zero,
     ends(-0.2, 0.2, -0.1, 0.1), strains<area_strain>},
    {MapKind::vorticity, "Vorticity", "2 × turn in rad", ", counter-clockwise positive",
     ScaleRule::about_zero, ends(-0.5, 0.5, -0.2, 0.2), strains<vorticity>},
    {MapKind::mobilised, "Mobilised friction of grains", "|f_t| / μf_n, mean over the contacts of a grain",
     "", ScaleRule::fixed, ends(0.0, 1.0), mobilisations, true, "no contact"},
    {MapKind::cells, "Local solid fraction", "area of a grain over that of its cell", "", ScaleRule::fixed,
     ends(0.65, 0.95), cell_fractions, true, "at the surface"},
    {MapKind::density, "Solid fraction", "area of grains over area", "", ScaleRule::fixed, ends(0.7, 0.9),
     coarse_values<solid_fraction>, true},
    {MapKind::stress, "Pressure", "P = σ_1 + σ_2 in ρgD", "", ScaleRule::by_depth, ends(0.0, 2.0),
     coarse_values<pressure>, true},
    {MapKind::shear_rate, "Shear rate", "in √(g/D)", "", ScaleRule::sizes, ends(1e-6, 0.1),
     coarse_values<dimensionless_shear_rate>, true},
    {MapKind::temperature, "Granular temperature", "in gD", "", ScaleRule::sizes, ends(1e-10, 1e-2),
     temperatures, true},
});

const ValueMap& value_map(MapKind kind) {
  const auto* const found = std::ranges::find(value_maps, kind, &ValueMap::kind);
  if (found == value_maps.end()) throw Error(ExitCode::internal, "a map that is no number of each grain");
  return *found;
}

Scale scale_of(const ValueMap& map, const MapFrame& of, const MapSettings& settings, bool per_degree) {
  constexpr int most_ticks = 4;
  const bool is_about_zero = map.rule == ScaleRule::about_zero;
  ScaleRange range = map.ends[per_degree];
  if (fits_frames(map.kind)) range = settings.motion.of(map.kind, per_degree).value_or(range);
  if (map.rule == ScaleRule::by_depth) {
    const double largest = range.high * std::max(1.0, of.statics.depth / of.statics.mean_diameter);
    const double step = round_step(largest, most_ticks);
    range.high = std::ceil(largest / step) * step;
  }
  return {is_about_zero ? ColourMap::diverging : ColourMap::viridis, range.low, range.high,
          map.rule == ScaleRule::sizes};
}

/// ", 5 to 99 % of grains" if the range is one that fits; empty if it is fixed or chosen.
std::string fitted_text(const ValueMap& map, const MotionRanges& motion, bool per_degree,
                        const ScaleChoice& choice) {
  if (choice.low || !fits_frames(map.kind) || !motion.of(map.kind, per_degree)) return "";
  if (map.rule == ScaleRule::about_zero) return fmt::format(", {:.6g} % of grains", 100.0 * signed_share);
  return fmt::format(", {:.6g} to {:.6g} % of grains", 100.0 * size_shares.low, 100.0 * size_shares.high);
}

}  // namespace

bool is_signed(MapKind kind) {
  const auto* const found = std::ranges::find(value_maps, kind, &ValueMap::kind);
  return found != value_maps.end() && found->rule == ScaleRule::about_zero;
}

ScaleRange fixed_motion_range(MapKind kind, bool per_degree) { return value_map(kind).ends[per_degree]; }

std::vector<double> map_values(MapKind kind, const MapFrame& of, const MapSettings& settings) {
  return value_map(kind).values(of, settings, motion_span(of));
}

MapLayer value_layer(MapKind kind, const MapFrame& of, const MapSettings& settings,
                     const ScaleChoice& choice) {
  const ValueMap& map = value_map(kind);
  const MotionSpan span = needs_reference(kind) ? motion_span(of) : MotionSpan{};
  const Scale scale = chosen(scale_of(map, of, settings, span.per_degree), choice);
  const std::string averaged =
      is_coarse(kind) ? fmt::format(", coarse-grained over {:.6g} D", settings.length) : std::string();
  const Bar bar = bar_of(scale, fmt::format("{}{}{}{}", map.bar, span.unit, map.sign,
                                            fitted_text(map, settings.motion, span.per_degree, choice)));
  MapLayer layer = (map.outlines ? scaled_layer_with_outlines : scaled_layer)(
      fmt::format("{}{}{}", map.title, span.title, averaged), scale, map.values(of, settings, span), bar);
  const GrainLook open = outline_look();
  if (!map.without.empty())
    layer.legend.swatches = {{Swatch::Kind::disc, open.fill, open.rim, 0.0, std::string(map.without)}};
  return layer;
}

}  // namespace talus
