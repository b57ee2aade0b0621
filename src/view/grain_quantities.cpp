#include "view/grain_quantities.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <numbers>

#include "analysis/free_grains.h"
#include "core/errors.h"
#include "core/trigonometry.h"
#include "stress/bed.h"

namespace talus {
namespace {

using Numbers = std::vector<double>;

/// What `value` says of each grain, by its id.
template <typename Value>
Numbers each(const GrainSource& of, const Value& value) {
  Numbers numbers;
  numbers.reserve(of.stored.x.size());
  for (std::size_t i = 0; i < of.stored.x.size(); ++i) numbers.push_back(static_cast<double>(value(i)));
  return numbers;
}

Numbers lengths(const GrainSource& of, const Numbers& metres) {
  return each(of, [&](std::size_t i) { return metres[i] / of.statics.mean_diameter; });
}

Numbers moved_along(const GrainSource& of) {
  if (of.first == nullptr || of.first->x.size() != of.stored.x.size())
    return Numbers(of.stored.x.size(), not_known);
  return each(of, [&](std::size_t i) {
    const double windings = of.stored.image[i] - of.first->image[i];
    return (of.stored.x[i] - of.first->x[i] + windings * period_of(of.statics)) / of.statics.mean_diameter;
  });
}

Numbers moved_across(const GrainSource& of) {
  if (of.first == nullptr || of.first->y.size() != of.stored.y.size())
    return Numbers(of.stored.y.size(), not_known);
  return each(of,
              [&](std::size_t i) { return (of.stored.y[i] - of.first->y[i]) / of.statics.mean_diameter; });
}

Numbers pressures(const GrainSource& of) {
  return each(of, [&](std::size_t i) {
    const Tensor2& moment = of.stored.internal_moment[i];
    return (moment.xx + moment.yy) / (std::numbers::pi * of.statics.radius[i] * of.statics.radius[i]);
  });
}

Numbers loaded(const GrainSource& of) {
  const FrameContacts& contacts = of.stored.contacts;
  const std::vector<Index> counts =
      loaded_contacts(contacts.a, contacts.b, contacts.fn, of.stored.grain_count());
  return {counts.begin(), counts.end()};
}

Numbers sliding(const GrainSource& of) {
  const FrameContacts& contacts = of.stored.contacts;
  Numbers counts(of.stored.x.size(), 0.0);
  for (std::size_t c = 0; c < contacts.a.size(); ++c) {
    if (contacts.status[c] != ContactStatus::sliding) continue;
    for (const Index body : {contacts.a[c], contacts.b[c]})
      if (body < of.stored.grain_count()) counts[static_cast<std::size_t>(body)] += 1.0;
  }
  return counts;
}

Numbers clusters(const GrainSource& of) {
  return each(of, [&](std::size_t i) { return i < of.clusters.label.size() ? of.clusters.label[i] : -1; });
}

Numbers overloaded(const GrainSource& of) {
  return each(of, [&](std::size_t i) { return i < of.clusters.label.size() && of.clusters.label[i] >= 0; });
}

Numbers critical_lengths(const GrainSource& of) {
  const CoarseGraining found = coarse_graining({of.mapped, of.statics}, of.rule);
  return each(of, [&](std::size_t i) {
    return i < found.length.size() ? found.length[i] / of.statics.mean_diameter : not_known;
  });
}

constexpr auto all_grain_quantities = std::to_array<GrainQuantity>({
    {"id", "1", "stable id of a grain", true, false,
     [](const GrainSource& of) { return each(of, [](std::size_t i) { return i; }); }},
    {"x", "D", "centre, along the bed, downslope", false, false,
     [](const GrainSource& of) { return lengths(of, of.stored.x); }},
    {"y", "D", "centre, across the bed, above the floor", false, false,
     [](const GrainSource& of) { return lengths(of, of.stored.y); }},
    {"radius", "D", "radius", false, false,
     [](const GrainSource& of) { return lengths(of, of.statics.radius); }},
    {"mass", "kg/m", "mass, per metre of thickness", false, false,
     [](const GrainSource& of) { return of.statics.mass; }},
    {"velocity_x", "m/s", "velocity along the bed", false, false,
     [](const GrainSource& of) { return of.stored.vx; }},
    {"velocity_y", "m/s", "velocity across the bed", false, false,
     [](const GrainSource& of) { return of.stored.vy; }},
    {"speed", "m/s", "size of the velocity", false, false,
     [](const GrainSource& of) {
       return each(of, [&](std::size_t i) { return std::hypot(of.stored.vx[i], of.stored.vy[i]); });
     }},
    {"angle", "deg", "angle turned since the beginning of the run, counter-clockwise positive", false, false,
     [](const GrainSource& of) {
       return each(of, [&](std::size_t i) { return degrees(of.stored.angle[i]); });
     }},
    {"angular_velocity", "rad/s", "rotation velocity, counter-clockwise positive", false, false,
     [](const GrainSource& of) { return of.stored.omega; }},
    {"displacement_x", "D", "how far it has moved along the bed since the first frame of the run", false,
     false, moved_along},
    {"displacement_y", "D", "the same across the bed", false, false, moved_across},
    {"internal_moment_xx", "J/m", "internal moment per metre of thickness, compression positive: M_xx", false,
     false,
     [](const GrainSource& of) {
       return each(of, [&](std::size_t i) { return of.stored.internal_moment[i].xx; });
     }},
    {"internal_moment_xy", "J/m", "M_xy", false, false,
     [](const GrainSource& of) {
       return each(of, [&](std::size_t i) { return of.stored.internal_moment[i].xy; });
     }},
    {"internal_moment_yx", "J/m", "M_yx", false, false,
     [](const GrainSource& of) {
       return each(of, [&](std::size_t i) { return of.stored.internal_moment[i].yx; });
     }},
    {"internal_moment_yy", "J/m", "M_yy", false, false,
     [](const GrainSource& of) {
       return each(of, [&](std::size_t i) { return of.stored.internal_moment[i].yy; });
     }},
    {"pressure", "Pa",
     "P = s1 + s2 of the stress of the grain, its internal moment over the area of its disk", false, false,
     pressures},
    {"gamma", "1", "stress ratio q/p of the grain alone; none where it carries nothing", false, false,
     [](const GrainSource& of) { return of.stored.gamma; }},
    {"gamma_neighbourhood", "1",
     "stress ratio of its neighbourhood, as the maps show it, of the diameter set with the map; none where "
     "it "
     "carries nothing",
     false, false, [](const GrainSource& of) { return of.mapped.gamma; }},
    {"coordination", "1", "contacts that carry force", true, false, loaded},
    {"sliding", "1", "contacts that slide", true, false, sliding},
    {"overloaded", "1", "1 for an overloaded grain, at the threshold set with the map; else 0", true, true,
     overloaded},
    {"lc", "D", "coarse-graining length of an overloaded grain; none for others", false, false,
     critical_lengths},
    {"cluster", "1", "cluster of an overloaded grain, 0 the largest of the frame; -1 for others", true, false,
     clusters},
});

}  // namespace

std::span<const GrainQuantity> grain_quantities() { return all_grain_quantities; }

const GrainQuantity& grain_quantity(std::string_view name) {
  const auto found = std::ranges::find(all_grain_quantities, name, &GrainQuantity::name);
  if (found == all_grain_quantities.end())
    throw Error(ExitCode::internal, fmt::format("no quantity {} of a grain", name));
  return *found;
}

std::string head_of(const GrainQuantity& quantity) {
  return quantity.unit == "1" ? std::string(quantity.name)
                              : fmt::format("{} ({})", quantity.name, quantity.unit);
}

const std::vector<ExpressionName>& grain_names() {
  static const std::vector<ExpressionName> names = [] {
    std::vector<ExpressionName> all;
    for (const GrainQuantity& quantity : all_grain_quantities)
      all.push_back({std::string(quantity.name), quantity.flag});
    return all;
  }();
  return names;
}

std::vector<Index> grains_where(const Expression& condition, const GrainSource& of) {
  std::vector<Numbers> columns;
  for (const std::string& name : condition.names) columns.push_back(grain_quantity(name).values(of));
  std::vector<Index> grains;
  Numbers row(columns.size());
  for (Index i = 0; i < of.statics.free_count; ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k) row[k] = columns[k][static_cast<std::size_t>(i)];
    if (holds(condition, row)) grains.push_back(i);
  }
  return grains;
}

}  // namespace talus
