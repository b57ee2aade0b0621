#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/core.h>
#include <numbers>

#include "analysis/contact_network.h"
#include "analysis/frame_quantities.h"
#include "analysis/free_grains.h"
#include "analysis/quantities.h"
#include "core/errors.h"
#include "stress/bed.h"

namespace talus {
namespace {

using Numbers = std::vector<double>;

/// What each of `says` tells of each grain by its id, or of each contact by its number, row by row.
template <typename... Says>
Numbers each(Index count, const Says&... says) {
  Numbers numbers;
  numbers.reserve(static_cast<std::size_t>(count) * sizeof...(says));
  for (Index k = 0; k < count; ++k) (numbers.push_back(static_cast<double>(says(k))), ...);
  return numbers;
}

template <typename... Says>
Numbers each_grain(const GrainSource& of, const Says&... says) {
  return each(of.frame.grain_count(), says...);
}

template <typename Number>
auto in(const std::vector<Number>& array) {
  return [&array](Index k) { return array[static_cast<std::size_t>(k)]; };
}

template <typename Number>
Numbers copied(const std::vector<Number>& array) {
  return {array.begin(), array.end()};
}

Numbers displacements(const GrainSource& of) {
  const Frame& now = of.frame;
  if (of.first == nullptr || of.first->x.size() != now.x.size()) return Numbers(2 * now.x.size(), not_known);
  const Frame& then = *of.first;
  const double period = of.statics.length;
  return each_grain(
      of, [&](Index i) { return now.x[i] - then.x[i] + (now.image[i] - then.image[i]) * period; },
      [&](Index i) { return now.y[i] - then.y[i]; });
}

Numbers moments(const GrainSource& of) {
  const std::vector<Tensor2>& moment = of.frame.internal_moment;
  return each_grain(
      of, [&](Index i) { return moment[i].xx; }, [&](Index i) { return moment[i].xy; },
      [&](Index i) { return moment[i].yx; }, [&](Index i) { return moment[i].yy; });
}

Numbers pressures(const GrainSource& of) {
  return each_grain(of, [&](Index i) {
    const Tensor2& moment = of.frame.internal_moment[i];
    const double radius = of.statics.radius[i];
    return (moment.xx + moment.yy) / (std::numbers::pi * radius * radius);
  });
}

Numbers coordination(const GrainSource& of) {
  const FrameContacts& contacts = of.frame.contacts;
  return copied(loaded_contacts(contacts.a, contacts.b, contacts.fn, of.frame.grain_count()));
}

Numbers sliding(const GrainSource& of) {
  const FrameContacts& contacts = of.frame.contacts;
  Numbers counts(of.frame.x.size(), 0.0);
  for (std::size_t c = 0; c < contacts.a.size(); ++c) {
    if (contacts.status[c] != ContactStatus::sliding) continue;
    for (const Index body : {contacts.a[c], contacts.b[c]})
      if (body < of.frame.grain_count()) counts[static_cast<std::size_t>(body)] += 1.0;
  }
  return counts;
}

/// What is known of free grains at a threshold; `other` is said of those of the floor, and where there is no
/// threshold.
template <typename Number>
Numbers at_threshold(const GrainSource& of, std::size_t threshold,
                     const std::vector<Number> FrameThreshold::*member, double other) {
  Numbers numbers(of.frame.x.size(), other);
  if (threshold < of.thresholds.size()) {
    const std::vector<Number>& known = of.thresholds[threshold].*member;
    std::copy(known.begin(), known.end(), numbers.begin());
  }
  return numbers;
}

Numbers clusters(const GrainSource& of, std::size_t threshold) {
  return at_threshold(of, threshold, &FrameThreshold::cluster, -1.0);
}

Numbers overloaded(const GrainSource& of, std::size_t threshold) {
  Numbers numbers = clusters(of, threshold);
  for (double& number : numbers) number = number >= 0.0 ? 1.0 : 0.0;
  return numbers;
}

constexpr auto all_of_grains = std::to_array<FrameQuantity>({
    {"id", FieldShape::scalar, FieldNumber::integer, "1", "stable id of a grain; free grains come first",
     [](const GrainSource& of, std::size_t) { return each_grain(of, [](Index i) { return i; }); }},
    {"type", FieldShape::scalar, FieldNumber::integer, "1", "1 free grain, 2 grain glued to the floor",
     [](const GrainSource& of, std::size_t) {
       return each_grain(of, [&](Index i) { return i < of.statics.free_count ? 1 : 2; });
     }},
    {"", FieldShape::vector, FieldNumber::single, "m",
     "centre: x along the bed, downslope, y across it, above the floor",
     [](const GrainSource& of, std::size_t) { return each_grain(of, in(of.frame.x), in(of.frame.y)); }},
    {"radius", FieldShape::scalar, FieldNumber::real, "m", "radius",
     [](const GrainSource& of, std::size_t) { return of.statics.radius; }},
    {"mass", FieldShape::scalar, FieldNumber::real, "kg/m", "mass, per metre of thickness",
     [](const GrainSource& of, std::size_t) { return of.statics.mass; }},
    {"image", FieldShape::vector, FieldNumber::integer, "1",
     "how often a grain left through the right periodic edge minus the left, and 0",
     [](const GrainSource& of, std::size_t) {
       return each_grain(of, in(of.frame.image), [](Index) { return 0; });
     }},
    {"velocity", FieldShape::vector, FieldNumber::single, "m/s", "velocity",
     [](const GrainSource& of, std::size_t) { return each_grain(of, in(of.frame.vx), in(of.frame.vy)); }},
    {"angle", FieldShape::scalar, FieldNumber::single, "rad",
     "angle turned since the beginning of the run, counter-clockwise positive",
     [](const GrainSource& of, std::size_t) { return of.frame.angle; }},
    {"angular_velocity", FieldShape::scalar, FieldNumber::single, "rad/s",
     "rotation velocity, counter-clockwise positive",
     [](const GrainSource& of, std::size_t) { return of.frame.omega; }},
    {"displacement", FieldShape::vector, FieldNumber::real, "m",
     "how far a grain has moved since the first frame of the run",
     [](const GrainSource& of, std::size_t) { return displacements(of); }},
    {"internal_moment", FieldShape::tensor, FieldNumber::single, "J/m",
     "internal moment tensor M_ij per metre of thickness (paper, Eq. 4), compression positive; the stress is "
     "M over an area",
     [](const GrainSource& of, std::size_t) { return moments(of); }},
    {"pressure", FieldShape::scalar, FieldNumber::real, "Pa",
     "P = s1 + s2 of the stress of the grain, its internal moment over the area of its disk",
     [](const GrainSource& of, std::size_t) { return pressures(of); }},
    {"gamma", FieldShape::scalar, FieldNumber::single, "1",
     "stress ratio q/p of the grain alone; no number where it carries nothing",
     [](const GrainSource& of, std::size_t) { return of.frame.gamma; }},
    {"gamma_neighbourhood", FieldShape::scalar, FieldNumber::real, "1",
     "stress ratio of the neighbourhood of the grain, of diameter l_min; no number where the grain carries "
     "nothing",
     [](const GrainSource& of, std::size_t) { return Numbers(of.gamma.begin(), of.gamma.end()); }},
    {"coordination", FieldShape::scalar, FieldNumber::integer, "1", "contacts of the grain that carry force",
     [](const GrainSource& of, std::size_t) { return coordination(of); }},
    {"sliding", FieldShape::scalar, FieldNumber::integer, "1", "contacts of the grain that slide",
     [](const GrainSource& of, std::size_t) { return sliding(of); }},
    {"speed", FieldShape::scalar, FieldNumber::single, "m/s", "size of the velocity",
     [](const GrainSource& of, std::size_t) {
       return each_grain(of, [&](Index i) { return std::hypot(of.frame.vx[i], of.frame.vy[i]); });
     }},
    {"overloaded", FieldShape::scalar, FieldNumber::integer, "1",
     "1 for an overloaded grain: a free one whose gamma_neighbourhood is not below the threshold; else 0",
     overloaded, true, true},
    {"lc", FieldShape::scalar, FieldNumber::single, "m",
     "coarse-graining length l_c of an overloaded grain; no number for other grains",
     [](const GrainSource& of, std::size_t threshold) {
       return at_threshold(of, threshold, &FrameThreshold::lc, not_known);
     },
     true},
    {"cluster", FieldShape::scalar, FieldNumber::integer, "1",
     "cluster of an overloaded grain, 0 the largest of the frame; -1 for other grains", clusters, true},
});

Numbers strong(const GrainSource& of) {
  const FrameContacts& contacts = of.frame.contacts;
  double sum = 0.0;
  for (const double force : contacts.fn) sum += force;
  return each(contacts.count(), [&](Index c) { return contacts.fn[c] * contacts.count() > sum ? 1 : 0; });
}

constexpr auto all_of_contacts = std::to_array<FrameQuantity>({
    {"a", FieldShape::scalar, FieldNumber::integer, "1", "id of the first grain",
     [](const GrainSource& of, std::size_t) { return copied(of.frame.contacts.a); }},
    {"b", FieldShape::scalar, FieldNumber::integer, "1",
     "id of the second body; from the number of grains on it is a plane: a side wall or a smooth floor",
     [](const GrainSource& of, std::size_t) { return copied(of.frame.contacts.b); }},
    {"shift", FieldShape::scalar, FieldNumber::integer, "1",
     "periodic image: b touches a from x_b + shift * L",
     [](const GrainSource& of, std::size_t) { return copied(of.frame.contacts.shift); }},
    {"point", FieldShape::vector, FieldNumber::single, "m", "contact point",
     [](const GrainSource& of, std::size_t) {
       return each(of.frame.contacts.count(), in(of.frame.contacts.px), in(of.frame.contacts.py));
     }},
    {"normal", FieldShape::vector, FieldNumber::single, "1", "unit normal n, from a to b",
     [](const GrainSource& of, std::size_t) {
       return each(of.frame.contacts.count(), in(of.frame.contacts.nx), in(of.frame.contacts.ny));
     }},
    {"normal_force", FieldShape::scalar, FieldNumber::single, "N/m",
     "f_n on b along n, per metre of thickness; compression positive",
     [](const GrainSource& of, std::size_t) { return of.frame.contacts.fn; }},
    {"tangential_force", FieldShape::scalar, FieldNumber::single, "N/m",
     "f_t on b along t = (-n_y, n_x), per metre of thickness",
     [](const GrainSource& of, std::size_t) { return of.frame.contacts.ft; }},
    {"mobilisation", FieldShape::scalar, FieldNumber::real, "1",
     "mobilised friction, the size of f_t over mu f_n",
     [](const GrainSource& of, std::size_t) {
       return each(of.frame.contacts.count(), [&](Index c) { return mobilisation_of(of, c); });
     }},
    {"status", FieldShape::scalar, FieldNumber::integer, "1",
     "1 sticking, 2 sliding (friction fully mobilised)",
     [](const GrainSource& of, std::size_t) {
       return each(of.frame.contacts.count(),
                   [&](Index c) { return static_cast<int>(of.frame.contacts.status[c]); });
     }},
    {"strong", FieldShape::scalar, FieldNumber::integer, "1",
     "1 where f_n is above its mean over the contacts of the frame, else 0",
     [](const GrainSource& of, std::size_t) { return strong(of); }},
});

}  // namespace

std::span<const FrameQuantity> grain_quantities() { return all_of_grains; }
std::span<const FrameQuantity> contact_quantities() { return all_of_contacts; }

std::vector<std::string> component_names(const FrameQuantity& quantity) {
  std::vector<std::string> names = {std::string(quantity.name)};
  if (quantity.shape == FieldShape::vector) names = {"x", "y"};
  if (quantity.shape == FieldShape::tensor) names = {"xx", "xy", "yx", "yy"};
  if (names.size() > 1 && !quantity.name.empty())
    for (std::string& name : names) name = fmt::format("{}_{}", quantity.name, name);
  return names;
}

const std::vector<GrainNumber>& grain_numbers() {
  static const std::vector<GrainNumber> numbers = [] {
    std::vector<GrainNumber> all;
    for (const FrameQuantity& quantity : all_of_grains)
      for (const std::string& name : component_names(quantity))
        all.push_back({name, &quantity,
                       !all.empty() && all.back().quantity == &quantity ? all.back().component + 1 : 0});
    return all;
  }();
  return numbers;
}

const GrainNumber& grain_number(std::string_view name) {
  const auto found = std::ranges::find(grain_numbers(), name, &GrainNumber::name);
  if (found == grain_numbers().end())
    throw Error(ExitCode::internal, fmt::format("no quantity {} of a grain", name));
  return *found;
}

std::vector<double> values_of(const GrainNumber& number, const GrainSource& of) {
  const std::vector<double> rows = number.quantity->values(of, 0);
  std::vector<double> values;
  for (std::size_t k = number.component; k < rows.size(); k += components(*number.quantity))
    values.push_back(scaled(number.quantity->unit, rows[k], of.statics.mean_diameter));
  return values;
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

}  // namespace talus
