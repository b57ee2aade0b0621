#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/core.h>
#include <numbers>

#include "analysis/contacts/contact_network.h"
#include "analysis/deformation/deformation.h"
#include "analysis/frame_quantities.h"
#include "analysis/free_grains.h"
#include "analysis/overload/coarse_graining.h"
#include "analysis/packing/packing.h"
#include "core/trigonometry.h"
#include "stress/stress.h"

namespace talus::analysis {
namespace {

using Numbers = std::vector<double>;
using enum FieldNumber;
using FieldShape::scalar, FieldShape::vector;

/// Returns the values of each function for each grain by id, or each contact by number, row by row.
template <typename... Functions>
Numbers each(Index count, const Functions&... functions) {
  Numbers numbers;
  numbers.reserve(static_cast<std::size_t>(count) * sizeof...(functions));
  for (Index k = 0; k < count; ++k) (numbers.push_back(static_cast<double>(functions(k))), ...);
  return numbers;
}

template <typename... Functions>
Numbers each_grain(const GrainSource& source, const Functions&... functions) {
  return each(source.frame.grain_count(), functions...);
}

/// Returns a function for an entry of an array that outlives it.
template <typename Number>
auto in(const std::vector<Number>& array) {
  return [&array](Index k) { return array[k]; };
}

/// Return arrays of the frame, or of its contacts, row by row.
template <auto... arrays>
Numbers of_grains(const GrainSource& source, std::size_t) {
  return each_grain(source, in(source.frame.*arrays)...);
}
template <auto... arrays>
Numbers of_contacts(const GrainSource& source, std::size_t) {
  return each(source.frame.contacts.count(), in(source.frame.contacts.*arrays)...);
}

Numbers displacements(const GrainSource& source, std::size_t) {
  const std::size_t count = source.frame.x.size();
  if (source.first == nullptr || source.first->x.size() != count) return Numbers(2 * count, not_known);
  return each_grain(
      source, [&](Index i) { return displacement(source, *source.first, i).x; },
      [&](Index i) { return displacement(source, *source.first, i).y; });
}

Numbers moments(const GrainSource& source, std::size_t) {
  const std::vector<Tensor2>& moment = source.frame.internal_moment;
  return each_grain(
      source, [&](Index i) { return moment[i].xx; }, [&](Index i) { return moment[i].xy; },
      [&](Index i) { return moment[i].yx; }, [&](Index i) { return moment[i].yy; });
}

Numbers pressures(const GrainSource& source, std::size_t) {
  return each_grain(source, [&](Index i) {
    const Tensor2& moment = source.frame.internal_moment[i];
    const double radius = source.statics.radius[i];
    return (moment.xx + moment.yy) / (std::numbers::pi * radius * radius);
  });
}

Numbers coordination(const GrainSource& source, std::size_t) {
  const FrameContacts& contacts = source.frame.contacts;
  return each_grain(source,
                    in(stress::contacts_of_grains(contacts.a, contacts.b, source.frame.grain_count())));
}

Numbers sliding(const GrainSource& source, std::size_t) {
  const FrameContacts& contacts = source.frame.contacts;
  Numbers counts(source.frame.x.size(), 0.0);
  for (std::size_t c = 0; c < contacts.a.size(); ++c) {
    if (contacts.status[c] != ContactStatus::sliding) continue;
    for (const Index body : {contacts.a[c], contacts.b[c]})
      if (body < source.frame.grain_count()) counts[body] += 1.0;
  }
  return counts;
}

/// Returns the values of free grains at a threshold. Floor grains have `other`, as do all grains if the
/// threshold does not exist.
template <typename Number>
Numbers at_threshold(const GrainSource& source, std::size_t threshold,
                     const std::vector<Number> FrameThreshold::*member, double other) {
  Numbers numbers(source.frame.x.size(), other);
  if (threshold < source.thresholds.size()) {
    const std::vector<Number>& known = source.thresholds[threshold].*member;
    std::copy(known.begin(), known.end(), numbers.begin());
  }
  return numbers;
}

Numbers clusters(const GrainSource& source, std::size_t threshold) {
  return at_threshold(source, threshold, &FrameThreshold::cluster, -1.0);
}

Numbers overloaded(const GrainSource& source, std::size_t threshold) {
  Numbers numbers = clusters(source, threshold);
  for (double& number : numbers) number = number >= 0.0 ? 1.0 : 0.0;
  return numbers;
}

/// Returns the mass of a grain over its area, kg/m^2; all grains have the same material.
double material_density(const RunStatics& statics) {
  return statics.mass.empty() ? 1.0 : statics.mass[0] / (pi * statics.radius[0] * statics.radius[0]);
}

/// Appends NaN for the floor grains to the values of the free grains.
Numbers with_floor(Numbers free_values, const GrainSource& source) {
  free_values.resize(source.frame.x.size(), not_known);
  return free_values;
}

template <typename Value>
Numbers each_free(const GrainSource& source, const Value& value) {
  return with_floor(each(source.statics.free_count, value), source);
}

/// Returns value(earlier frame, i) for each free grain, per degree; 0 if there is no such frame.
template <typename Value>
Numbers since_earlier(const GrainSource& source, const Value& value) {
  const bool known = source.earlier != nullptr && source.earlier->grain_count() == source.frame.grain_count();
  return each_free(source, [&](Index i) { return known ? value(*source.earlier, i) / source.degrees : 0.0; });
}

template <typename Value>
Numbers deformation_numbers(const GrainSource& source, const Value& value) {
  std::vector<LocalDeformation> all;
  if (source.earlier != nullptr) all = local_deformations(*source.earlier, source);
  return since_earlier(source, [&](const Frame&, Index i) { return value(all[i]); });
}

template <double (*strain)(const Tensor2&)>
Numbers strains(const GrainSource& source, std::size_t) {
  return deformation_numbers(source, [](const LocalDeformation& each) { return strain(each.gradient); });
}

Numbers distances(const GrainSource& source, std::size_t) {
  return since_earlier(source, [&](const Frame& earlier, Index i) {
    const Vec2 moved = displacement(source, earlier, i);
    return std::hypot(moved.x, moved.y);
  });
}

Numbers rotations(const GrainSource& source, std::size_t) {
  return since_earlier(
      source, [&](const Frame& earlier, Index i) { return source.frame.angle[i] - earlier.angle[i]; });
}

double solid_fraction(const CoarseField& field, const RunStatics& statics) {
  return field.density / material_density(statics);
}

double pressure(const CoarseField& field, const RunStatics&) {
  const Tensor2 stress = field.stress();
  return stress.xx + stress.yy;
}

double rate_of_shear(const CoarseField& field, const RunStatics&) {
  return shear_strain(field.velocity_gradient);
}

template <double (*value)(const CoarseField& field, const RunStatics& statics)>
Numbers coarse_values(const GrainSource& source, std::size_t) {
  const CoarseFields fields(source, 0.5 * source.length);
  return each_free(source, [&](Index i) {
    return value(fields.at(source.frame.x[i], source.frame.y[i]), source.statics);
  });
}

constexpr std::string_view turned = ", counter-clockwise positive";

constexpr FrameQuantity mapped(FrameQuantity quantity, const MapRule& map) {
  quantity.map = map;
  return quantity;
}

constexpr auto all_of_grains = std::to_array<FrameQuantity>({
    {"id", scalar, integer, "1", "stable id of a grain; free grains come first",
     [](const GrainSource& source, std::size_t) { return each_grain(source, [](Index i) { return i; }); }},
    {"type", scalar, integer, "1", "1 free grain, 2 grain glued to the floor",
     [](const GrainSource& source, std::size_t) {
       return each_grain(source, [&](Index i) { return i < source.statics.free_count ? 1 : 2; });
     }},
    {"", vector, single, "m", "centre: x along the bed, downslope, y across it, above the floor",
     of_grains<&Frame::x, &Frame::y>},
    {"radius", scalar, real, "m", "radius",
     [](const GrainSource& source, std::size_t) { return source.statics.radius; }},
    {"mass", scalar, real, "kg/m", "mass, per metre of thickness",
     [](const GrainSource& source, std::size_t) { return source.statics.mass; }},
    {"image", vector, integer, "1",
     "number of exits through the right periodic edge minus those through the left, and 0",
     [](const GrainSource& source, std::size_t) {
       return each_grain(source, in(source.frame.image), [](Index) { return 0; });
     }},
    {"velocity", vector, single, "m/s", "velocity", of_grains<&Frame::vx, &Frame::vy>},
    {"angle", scalar, single, "rad",
     "angle turned since the beginning of the run, counter-clockwise positive", of_grains<&Frame::angle>},
    {"angular_velocity", scalar, single, "rad/s", "rotation velocity, counter-clockwise positive",
     of_grains<&Frame::omega>},
    {"displacement", vector, real, "m", "displacement since the first frame of the run", displacements},
    {"internal_moment", FieldShape::tensor, single, "J/m",
     "internal moment tensor M_ij per metre of thickness (paper, Eq. 4), compression positive; the stress is "
     "M over an area",
     moments},
    // Below a depth of H grains the mean pressure in grains is about 2 rho g H and that of the bed about 1.5
    // rho g H. Both are larger where forces concentrate.
    mapped(
        {"pressure", scalar, real, "Pa",
         "P = s1 + s2 of the stress of the grain, its internal moment over the area of its disk", pressures},
        {"pressure", "pressure in each grain, over rho g D", "Pressure in each grain", "P = σ_1 + σ_2 (ρgD)",
         "P", ScaleRule::by_depth, 0.0, 3.0}),
    {"gamma", scalar, single, "1", "stress ratio q/p of the single grain; no value if it carries nothing",
     of_grains<&Frame::gamma>},
    {"gamma_neighbourhood", scalar, real, "1",
     "stress ratio of the neighbourhood of the grain, of diameter l_min; no value if the grain carries "
     "nothing",
     [](const GrainSource& source, std::size_t) {
       return Numbers(source.gamma.begin(), source.gamma.end());
     }},
    {"coordination", scalar, integer, "1", "contacts of the grain that carry force", coordination},
    {"sliding", scalar, integer, "1", "contacts of the grain that slide", sliding},
    mapped({"speed", scalar, single, "m/s", "magnitude of the velocity",
            [](const GrainSource& source, std::size_t) {
              return each_grain(source,
                                [&](Index i) { return std::hypot(source.frame.vx[i], source.frame.vy[i]); });
            }},
           {"speed", "speed of each grain, over sqrt(g D)", "Speed of grains", "speed (√(gD))", "speed",
            ScaleRule::sizes, 1e-5, 1.0}),
    mapped({"mobilised_friction", scalar, real, "1",
            "mobilised friction, the mean over the contacts of a grain; no value without contacts",
            [](const GrainSource& source, std::size_t) {
              return with_floor(mobilised_friction_of_grains(source), source);
            }},
           {"mobilised", "mobilised friction of each grain, the mean over its contacts",
            "Mobilised friction of grains", "|f_t| / μf_n, mean over the contacts of a grain", "|f_t| / μf_n",
            ScaleRule::fixed, 0.0, 1.0, true, "no contact"}),
    mapped({"solid_fraction", scalar, real, "1",
            "share of its cell that a grain fills; no value at the free surface",
            [](const GrainSource& source, std::size_t) {
              return with_floor(local_solid_fractions(source), source);
            }},
           {"cells", "local solid fraction: the share of its cell that each grain fills",
            "Local solid fraction", "area of a grain over that of its cell", "solid fraction",
            ScaleRule::fixed, 0.65, 0.95, true, "at the surface"}),
    {"overloaded", scalar, integer, "1",
     "1 for an overloaded grain, a free grain whose gamma_neighbourhood is at least the threshold; else 0",
     overloaded, FrameNeed::threshold, true},
    {"lc", scalar, single, "m",
     "coarse-graining length l_c of an overloaded grain; no value for other grains",
     [](const GrainSource& source, std::size_t threshold) {
       return at_threshold(source, threshold, &FrameThreshold::lc, not_known);
     },
     FrameNeed::threshold},
    {"cluster", scalar, integer, "1",
     "cluster of an overloaded grain, 0 the largest of the frame; -1 for other grains", clusters,
     FrameNeed::threshold},
    mapped({"distance", scalar, real, "m", "distance that a grain has moved", distances,
            FrameNeed::earlier_frame},
           {"displacement", "distance that each grain has moved; over another map: arrows", "Displacement",
            "displacement (D)", "displacement", ScaleRule::sizes, 1e-3, 10.0, false, "", 1e-4, 10.0}),
    mapped({"rotation", scalar, real, "rad", "rotation of a grain, counter-clockwise positive", rotations,
            FrameNeed::earlier_frame},
           {"rotation", "rotation of each grain", "Rotation", "rotation (°)", "rotation",
            ScaleRule::about_zero, -30.0, 30.0, false, "", -10.0, 10.0, turned}),
    mapped({"nonaffine_displacement", scalar, real, "m",
            "root mean square displacement of the neighbours relative to their common strain",
            [](const GrainSource& source, std::size_t) {
              return deformation_numbers(
                  source, [](const LocalDeformation& each) { return std::sqrt(each.nonaffine); });
            },
            FrameNeed::earlier_frame},
           {"nonaffine",
            "non-affine displacement: how far the neighbours of a grain have moved relative to their common "
            "strain",
            "Non-affine displacement", "D_m_i_n (D)", "D_m_i_n", ScaleRule::sizes, 1e-4, 1.0, false, "", 1e-5,
            1.0}),
    mapped(
        {"shear_strain", scalar, real, "1", "shear strain s1 - s2 of the neighbourhood",
         strains<shear_strain>, FrameNeed::earlier_frame},
        {"shear", "shear strain of the neighbourhood of each grain", "Shear strain",
         "s_1 − s_2 of neighbourhoods", "shear strain", ScaleRule::sizes, 1e-4, 1.0, false, "", 1e-5, 1.0}),
    mapped(
        {"area_strain", scalar, real, "1", "relative change of area of the neighbourhood; dilation positive",
         strains<area_strain>, FrameNeed::earlier_frame},
        {"dilation", "change of area of the neighbourhood of each grain", "Dilation",
         "ΔA/A of neighbourhoods", "ΔA/A", ScaleRule::about_zero, -0.2, 0.2, false, "", -0.1, 0.1}),
    mapped({"vorticity", scalar, real, "1",
            "twice the angle by which the neighbourhood has turned, counter-clockwise positive",
            strains<vorticity>, FrameNeed::earlier_frame},
           {"vorticity", "twice the rotation of the neighbourhood of each grain", "Vorticity",
            "2 × turn (rad)", "vorticity", ScaleRule::about_zero, -0.5, 0.5, false, "", -0.2, 0.2, turned}),
    mapped({"coarse_solid_fraction", scalar, real, "1", "coarse-grained solid fraction",
            coarse_values<solid_fraction>, FrameNeed::length},
           {"density", "coarse-grained solid fraction", "Solid fraction", "area of grains over area",
            "solid fraction", ScaleRule::fixed, 0.7, 0.9, true}),
    mapped({"coarse_pressure", scalar, real, "Pa", "P = s1 + s2 of the coarse-grained stress",
            coarse_values<pressure>, FrameNeed::length},
           {"stress", "coarse-grained pressure, over rho g D", "Pressure", "P = σ_1 + σ_2 (ρgD)", "P",
            ScaleRule::by_depth, 0.0, 2.0, true}),
    mapped({"coarse_shear_rate", scalar, real, "1/s", "coarse-grained shear rate",
            coarse_values<rate_of_shear>, FrameNeed::length},
           {"shear_rate", "coarse-grained shear rate, over sqrt(g / D)", "Shear rate", "shear rate (√(g/D))",
            "shear rate", ScaleRule::sizes, 1e-6, 0.1, true}),
    mapped({"temperature", scalar, real, "m^2/s^2", "granular temperature",
            [](const GrainSource& source, std::size_t) {
              return with_floor(granular_temperatures(source, 0.5 * source.length), source);
            },
            FrameNeed::length},
           {"temperature", "granular temperature, over g D", "Granular temperature", "temperature (gD)",
            "temperature", ScaleRule::sizes, 1e-10, 1e-2, true}),
});

Numbers strong(const GrainSource& source, std::size_t) {
  const FrameContacts& contacts = source.frame.contacts;
  double sum = 0.0;
  for (const double force : contacts.fn) sum += force;
  return each(contacts.count(), [&](Index c) { return contacts.fn[c] * contacts.count() > sum ? 1 : 0; });
}

constexpr auto all_of_contacts = std::to_array<FrameQuantity>({
    {"a", scalar, integer, "1", "id of the first grain", of_contacts<&FrameContacts::a>},
    {"b", scalar, integer, "1",
     "id of the second body; an id not below the number of grains is a plane: a side wall or a smooth floor",
     of_contacts<&FrameContacts::b>},
    {"shift", scalar, integer, "1", "periodic image: b touches a from x_b + shift * L",
     of_contacts<&FrameContacts::shift>},
    {"point", vector, single, "m", "contact point", of_contacts<&FrameContacts::px, &FrameContacts::py>},
    {"normal", vector, single, "1", "unit normal n, from a to b",
     of_contacts<&FrameContacts::nx, &FrameContacts::ny>},
    {"normal_force", scalar, single, "N/m", "f_n on b along n, per metre of thickness; compression positive",
     of_contacts<&FrameContacts::fn>},
    {"tangential_force", scalar, single, "N/m", "f_t on b along t = (-n_y, n_x), per metre of thickness",
     of_contacts<&FrameContacts::ft>},
    {"mobilisation", scalar, real, "1", "mobilised friction, the magnitude of f_t over mu f_n",
     [](const GrainSource& source, std::size_t) {
       return each(source.frame.contacts.count(), [&](Index c) { return mobilisation_of(source, c); });
     }},
    {"status", scalar, integer, "1", "1 sticking, 2 sliding (friction fully mobilised)",
     [](const GrainSource& source, std::size_t) {
       return each(source.frame.contacts.count(),
                   [&](Index c) { return static_cast<int>(source.frame.contacts.status[c]); });
     }},
    {"strong", scalar, integer, "1", "1 if f_n is above its mean over the contacts of the frame, else 0",
     strong, FrameNeed::nothing, true},
});

}  // namespace

std::span<const FrameQuantity> grain_quantities() { return all_of_grains; }
std::span<const FrameQuantity> contact_quantities() { return all_of_contacts; }

BedUnit bed_unit(std::string_view unit, const RunStatics& statics) {
  const double diameter = statics.mean_diameter, gravity = statics.gravity;
  if (unit == "m") return {"D", diameter};
  if (unit == "rad") return {"°", radians(1.0)};
  if (unit == "m/s") return {"√(gD)", std::sqrt(gravity * diameter)};
  if (unit == "1/s" || unit == "rad/s") return {"√(g/D)", std::sqrt(gravity / diameter)};
  if (unit == "m^2/s^2") return {"gD", gravity * diameter};
  if (unit == "Pa") return {"ρgD", material_density(statics) * gravity * diameter};
  return {unit == "1" ? "" : std::string(unit), 1.0};
}

FrameQuantity row_of(const OwnQuantity& own) {
  FrameQuantity row{own.name, FieldShape::scalar, FieldNumber::real, own.unit, own.label};
  if (own.kind != OwnQuantity::Kind::number) row.number = FieldNumber::integer;
  if (own.unit.empty()) row.unit = "1";
  row.flag = own.kind == OwnQuantity::Kind::flag;
  return row;
}

std::vector<std::string> component_names(const FrameQuantity& quantity) {
  std::vector<std::string> names = {std::string(quantity.name)};
  if (quantity.shape == FieldShape::vector) names = {"x", "y"};
  if (quantity.shape == FieldShape::tensor) names = {"xx", "xy", "yx", "yy"};
  if (names.size() > 1 && !quantity.name.empty())
    for (std::string& name : names) name = fmt::format("{}_{}", quantity.name, name);
  return names;
}

std::string threshold_ending(double factor) {
  std::string text = fmt::format("_{}", factor);
  std::ranges::replace(text, '.', '_');
  return text;
}

void append_number(std::string& text, double value, FieldNumber number, std::string_view nan) {
  if (std::isnan(value))
    text += nan;
  else if (number == FieldNumber::integer)
    text += fmt::format("{}", static_cast<std::int64_t>(value));
  else if (number == FieldNumber::single)
    text += fmt::format("{}", static_cast<float>(value));
  else
    text += fmt::format("{}", value);
}

}  // namespace talus::analysis
