#include "exports/fields.h"

#include <algorithm>

#include "base/text.h"

namespace talus::exports {
namespace {

/// Names of a quantity in other programs; empty: the same name as in other formats.
struct ForeignNames {
  std::string_view name, xyz, lammps;
};

constexpr ForeignNames other_names[] = {{"type", "kind", ""},
                                        {"image", "", "ix iy"},
                                        {"velocity", "velo", "vx vy"},
                                        {"angular_velocity", "", "omegaz"},
                                        {"displacement", "disp", "displacementx displacementy"},
                                        {"coordination", "n_neighb", ""}};

ForeignNames foreign_names(const analysis::FrameQuantity& field) {
  const auto* found = std::ranges::find(other_names, field.name, &ForeignNames::name);
  return found == std::end(other_names) ? ForeignNames{} : *found;
}

std::vector<FieldColumn> columns(std::span<const analysis::FrameQuantity> fields,
                                 const analysis::GrainSource& frame) {
  std::vector<FieldColumn> found;
  for (const analysis::FrameQuantity& field : fields) {
    if (field.name.empty() || !analysis::is_of_frame(field))
      continue;  // the centre, and quantities that are measured in other ways
    const bool by_threshold = field.need == analysis::FrameNeed::threshold;
    if (!by_threshold) found.push_back({field, "", field.values(frame, 0)});
    for (std::size_t f = 0; by_threshold && f < frame.thresholds.size(); ++f)
      found.push_back({field, analysis::threshold_ending(frame.factors[f]), field.values(frame, f)});
  }
  return found;
}

}  // namespace

std::vector<FieldColumn> grain_columns(const analysis::GrainSource& frame) {
  return columns(analysis::grain_quantities(), frame);
}

std::vector<FieldColumn> contact_columns(const analysis::GrainSource& frame) {
  return columns(analysis::contact_quantities(), frame);
}

std::vector<std::string> component_names(const FieldColumn& column) {
  std::vector<std::string> names = analysis::component_names(column.field);
  for (std::string& name : names) name += column.ending;
  return names;
}

std::string xyz_name(const FieldColumn& column) {
  const std::string_view name = foreign_names(column.field).xyz;
  return name.empty() ? column.name() : std::string(name);
}

std::string lammps_names(const FieldColumn& column) {
  const std::string_view names = foreign_names(column.field).lammps;
  return names.empty() ? joined(component_names(column), " ") : std::string(names);
}

}  // namespace talus::exports
