#include "export/fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <iterator>
#include <numbers>

#include "analysis/contact_network.h"
#include "core/text.h"
#include "stress/bed.h"

namespace talus {
namespace {

using Values = std::vector<double>;

/// What `of` says of each grain, by its id, or of each contact, by its number.
template <typename Of>
Values of_each(Index count, const Of& of) {
  Values values;
  for (Index k = 0; k < count; ++k) values.push_back(static_cast<double>(of(k)));
  return values;
}

/// The same of two components.
template <typename X, typename Y>
Values of_each(Index count, const X& x, const Y& y) {
  Values values;
  for (Index k = 0; k < count; ++k) {
    values.push_back(static_cast<double>(x(k)));
    values.push_back(static_cast<double>(y(k)));
  }
  return values;
}

template <typename Number>
auto in(const std::vector<Number>& array) {
  return [&array](Index k) { return array[static_cast<std::size_t>(k)]; };
}

template <typename Number>
Values copied(const std::vector<Number>& array) {
  return {array.begin(), array.end()};
}

Values ids(const ExportedFrame& of, std::size_t) {
  return of_each(of.frame.grain_count(), [](Index i) { return i; });
}

Values types(const ExportedFrame& of, std::size_t) {
  return of_each(of.frame.grain_count(), [&](Index i) { return i < of.run.statics.free_count ? 1 : 2; });
}

Values displacements(const ExportedFrame& of, std::size_t) {
  const Frame &now = of.frame, &then = of.run.first;
  const double period = of.run.statics.length;
  const auto moved = [&](Index i) {
    const auto k = static_cast<std::size_t>(i);
    return now.x[k] - then.x[k] + (now.image[k] - then.image[k]) * period;
  };
  const auto risen = [&](Index i) {
    return now.y[static_cast<std::size_t>(i)] - then.y[static_cast<std::size_t>(i)];
  };
  return of_each(now.grain_count(), moved, risen);
}

Values moments(const ExportedFrame& of, std::size_t) {
  Values values;
  for (const Tensor2& moment : of.frame.internal_moment)
    for (const double component : {moment.xx, moment.xy, moment.yx, moment.yy}) values.push_back(component);
  return values;
}

Values pressures(const ExportedFrame& of, std::size_t) {
  return of_each(of.frame.grain_count(), [&](Index i) {
    const auto k = static_cast<std::size_t>(i);
    const double radius = of.run.statics.radius[k];
    return (of.frame.internal_moment[k].xx + of.frame.internal_moment[k].yy) /
           (std::numbers::pi * radius * radius);
  });
}

Values coordination(const ExportedFrame& of, std::size_t) {
  const FrameContacts& contacts = of.frame.contacts;
  return copied(loaded_contacts(contacts.a, contacts.b, contacts.fn, of.frame.grain_count()));
}

Values overloaded(const ExportedFrame& of, std::size_t threshold) {
  const std::vector<Index>& cluster = of.thresholds[threshold].cluster;
  return of_each(of.frame.grain_count(), [&](Index i) { return cluster[i] >= 0 ? 1 : 0; });
}

constexpr auto all_grain_fields = std::to_array<Field>({
    {"id", "", "", FieldShape::scalar, FieldNumber::integer, "1",
     "stable id of a grain; free grains come first", ids},
    {"type", "kind", "", FieldShape::scalar, FieldNumber::integer, "1",
     "1 free grain, 2 grain glued to the floor", types},
    {"radius", "", "", FieldShape::scalar, FieldNumber::real, "m", "radius",
     [](const ExportedFrame& of, std::size_t) { return of.run.statics.radius; }},
    {"mass", "", "", FieldShape::scalar, FieldNumber::real, "kg/m", "mass, per metre of thickness",
     [](const ExportedFrame& of, std::size_t) { return of.run.statics.mass; }},
    {"image", "", "ix iy", FieldShape::vector, FieldNumber::integer, "1",
     "how often a grain left through the right periodic edge minus the left, and 0",
     [](const ExportedFrame& of, std::size_t) {
       return of_each(of.frame.grain_count(), in(of.frame.image), [](Index) { return 0; });
     }},
    {"velocity", "velo", "vx vy", FieldShape::vector, FieldNumber::single, "m/s", "velocity",
     [](const ExportedFrame& of, std::size_t) {
       return of_each(of.frame.grain_count(), in(of.frame.vx), in(of.frame.vy));
     }},
    {"angle", "", "", FieldShape::scalar, FieldNumber::single, "rad",
     "angle turned since the beginning of the run, counter-clockwise positive",
     [](const ExportedFrame& of, std::size_t) { return of.frame.angle; }},
    {"angular_velocity", "", "omegaz", FieldShape::scalar, FieldNumber::single, "rad/s",
     "rotation velocity, counter-clockwise positive",
     [](const ExportedFrame& of, std::size_t) { return of.frame.omega; }},
    {"displacement", "disp", "displacementx displacementy", FieldShape::vector, FieldNumber::real, "m",
     "how far a grain has moved since the first frame of the run", displacements},
    {"internal_moment", "", "", FieldShape::tensor, FieldNumber::single, "J/m",
     "internal moment tensor M_ij per metre of thickness (paper, Eq. 4), compression positive; the stress is "
     "M over an area",
     moments},
    {"pressure", "", "", FieldShape::scalar, FieldNumber::real, "Pa",
     "P = s1 + s2 of the stress of the grain, its internal moment over the area of its disk", pressures},
    {"gamma", "", "", FieldShape::scalar, FieldNumber::single, "1",
     "stress ratio q/p of the grain alone; NaN where it carries nothing",
     [](const ExportedFrame& of, std::size_t) { return of.frame.gamma; }},
    {"gamma_neighbourhood", "", "", FieldShape::scalar, FieldNumber::real, "1",
     "stress ratio of the neighbourhood of the grain, of diameter l_min, as the analysis has it; NaN where "
     "it "
     "carries nothing",
     [](const ExportedFrame& of, std::size_t) { return of.gamma; }},
    {"coordination", "n_neighb", "", FieldShape::scalar, FieldNumber::integer, "1",
     "contacts of the grain that carry force", coordination},
    {"overloaded", "", "", FieldShape::scalar, FieldNumber::integer, "1",
     "1 for an overloaded grain: a free one whose gamma_neighbourhood is not below this times Gamma_c; else "
     "0",
     overloaded, true},
    {"lc", "", "", FieldShape::scalar, FieldNumber::single, "m",
     "coarse-graining length l_c of an overloaded grain; NaN for other grains",
     [](const ExportedFrame& of, std::size_t threshold) { return copied(of.thresholds[threshold].lc); },
     true},
    {"cluster", "", "", FieldShape::scalar, FieldNumber::integer, "1",
     "cluster of an overloaded grain, 0 the largest of the frame; -1 for other grains",
     [](const ExportedFrame& of, std::size_t threshold) { return copied(of.thresholds[threshold].cluster); },
     true},
});

Values mobilisation(const ExportedFrame& of, std::size_t) {
  return of_each(of.frame.contacts.count(), [&](Index c) {
    return mobilisation_of({of.frame, of.run.statics}, c);
  });
}

Values strong(const ExportedFrame& of, std::size_t) {
  const FrameContacts& contacts = of.frame.contacts;
  double sum = 0.0;
  for (const double force : contacts.fn) sum += force;
  return of_each(contacts.count(), [&](Index c) { return contacts.fn[c] * contacts.count() > sum ? 1 : 0; });
}

constexpr auto all_contact_fields = std::to_array<Field>({
    {"a", "", "", FieldShape::scalar, FieldNumber::integer, "1", "id of the first grain",
     [](const ExportedFrame& of, std::size_t) { return copied(of.frame.contacts.a); }},
    {"b", "", "", FieldShape::scalar, FieldNumber::integer, "1",
     "id of the second body; from the number of grains on it is a plane: a side wall or a smooth floor",
     [](const ExportedFrame& of, std::size_t) { return copied(of.frame.contacts.b); }},
    {"shift", "", "", FieldShape::scalar, FieldNumber::integer, "1",
     "periodic image: b touches a from x_b + shift * L",
     [](const ExportedFrame& of, std::size_t) { return copied(of.frame.contacts.shift); }},
    {"point", "", "", FieldShape::vector, FieldNumber::single, "m", "contact point",
     [](const ExportedFrame& of, std::size_t) {
       const FrameContacts& contacts = of.frame.contacts;
       return of_each(contacts.count(), in(contacts.px), in(contacts.py));
     }},
    {"normal", "", "", FieldShape::vector, FieldNumber::single, "1", "unit normal n, from a to b",
     [](const ExportedFrame& of, std::size_t) {
       const FrameContacts& contacts = of.frame.contacts;
       return of_each(contacts.count(), in(contacts.nx), in(contacts.ny));
     }},
    {"normal_force", "", "", FieldShape::scalar, FieldNumber::single, "N/m",
     "f_n on b along n, per metre of thickness; compression positive",
     [](const ExportedFrame& of, std::size_t) { return of.frame.contacts.fn; }},
    {"tangential_force", "", "", FieldShape::scalar, FieldNumber::single, "N/m",
     "f_t on b along t = (-n_y, n_x), per metre of thickness",
     [](const ExportedFrame& of, std::size_t) { return of.frame.contacts.ft; }},
    {"mobilisation", "", "", FieldShape::scalar, FieldNumber::real, "1",
     "mobilised friction, the size of f_t over mu f_n", mobilisation},
    {"status", "", "", FieldShape::scalar, FieldNumber::integer, "1",
     "1 sticking, 2 sliding (friction fully mobilised)",
     [](const ExportedFrame& of, std::size_t) {
       const std::vector<ContactStatus>& status = of.frame.contacts.status;
       return of_each(of.frame.contacts.count(), [&](Index c) { return static_cast<int>(status[c]); });
     }},
    {"strong", "", "", FieldShape::scalar, FieldNumber::integer, "1",
     "1 where f_n is above its mean over the contacts of the frame, else 0", strong},
});

/// "_2" of the factor 2, "_1_5" of 1.5: a dot in a name means a component to OVITO.
std::string ending_of(double factor) {
  std::string text = fmt::format("_{}", factor);
  std::ranges::replace(text, '.', '_');
  return text;
}

std::vector<FieldColumn> columns(std::span<const Field> fields, const ExportedFrame& frame) {
  std::vector<FieldColumn> found;
  for (const Field& field : fields) {
    if (!field.by_threshold) found.push_back({field, "", field.values(frame, 0)});
    for (std::size_t f = 0; field.by_threshold && f < frame.thresholds.size(); ++f)
      found.push_back({field, ending_of(frame.run.analysis.thresholds[f].factor), field.values(frame, f)});
  }
  return found;
}

}  // namespace

std::span<const Field> grain_fields() { return all_grain_fields; }
std::span<const Field> contact_fields() { return all_contact_fields; }

std::vector<FieldColumn> grain_columns(const ExportedFrame& frame) {
  return columns(all_grain_fields, frame);
}

std::vector<FieldColumn> contact_columns(const ExportedFrame& frame) {
  return columns(all_contact_fields, frame);
}

std::vector<std::string> component_names(const FieldColumn& column) {
  switch (column.field.shape) {
    case FieldShape::scalar:
      break;
    case FieldShape::vector:
      return {column.name() + "_x", column.name() + "_y"};
    case FieldShape::tensor:
      return {column.name() + "_xx", column.name() + "_xy", column.name() + "_yx", column.name() + "_yy"};
  }
  return {column.name()};
}

}  // namespace talus
