#include <algorithm>
#include <fmt/core.h>
#include <span>
#include <string_view>
#include <vector>

#include "base/text.h"
#include "exports/writers.h"

namespace talus::exports {
namespace {

std::string head_of(std::string_view name, std::string_view unit) {
  return unit == "1" ? std::string(name) : fmt::format("{} ({})", name, unit);
}

std::string heads_of(std::span<const FieldColumn> columns) {
  std::string text;
  for (const FieldColumn& column : columns)
    for (const std::string& name : component_names(column))
      text.append(",").append(head_of(name, column.field.unit));
  return text;
}

void append_columns(std::string& text, std::span<const FieldColumn> columns, std::size_t row) {
  for (const FieldColumn& column : columns) {
    const std::size_t width = analysis::components(column.field);
    for (std::size_t c = 0; c < width; ++c) {
      text += ',';
      analysis::append_number(text, column.values[row * width + c], column.field.number, "");
    }
  }
}

}  // namespace

CsvRows frame_csv(const analysis::GrainSource& source) {
  return {"frame,step,time (s),tilt (rad)\n", fmt::format("{},{},{},{}\n", source.number, source.frame.step,
                                                          source.frame.time, source.frame.tilt)};
}

CsvRows grains_csv(const analysis::GrainSource& source) {
  const std::vector<FieldColumn> all = grain_columns(source);
  const auto before = std::span(all).first(columns_before_centre),
             after = std::span(all).subspan(columns_before_centre);
  CsvRows csv = {fmt::format("frame{},x (m),y (m){}\n", heads_of(before), heads_of(after)), ""};
  for (std::size_t i = 0; i < source.frame.x.size(); ++i) {
    csv.rows += fmt::format("{}", source.number);
    append_columns(csv.rows, before, i);
    for (const double coordinate : {source.frame.x[i], source.frame.y[i]}) {
      csv.rows += ',';
      analysis::append_number(csv.rows, coordinate, analysis::FieldNumber::single);
    }
    append_columns(csv.rows, after, i);
    csv.rows += '\n';
  }
  return csv;
}

CsvRows contacts_csv(const analysis::GrainSource& source) {
  const std::vector<FieldColumn> columns = contact_columns(source);
  CsvRows csv = {fmt::format("frame{}\n", heads_of(columns)), ""};
  for (std::size_t c = 0; c < source.frame.contacts.a.size(); ++c) {
    csv.rows += fmt::format("{}", source.number);
    append_columns(csv.rows, columns, c);
    csv.rows += '\n';
  }
  return csv;
}

std::string observables_csv(std::span<const ObservableRow> rows) {
  std::string text = joined(observable_fields, ",",
                            [](const SeriesField& field) { return head_of(field.name, field.unit); }) +
                     "\n";
  for (const ObservableRow& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (k > 0) text += ',';
      analysis::append_number(text, row[k], analysis::FieldNumber::real, "");
    }
    text += '\n';
  }
  return text;
}

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
                                 const analysis::GrainSource& frame, bool of_grains) {
  std::vector<FieldColumn> found;
  for (const analysis::FrameQuantity& field : fields) {
    if (field.name.empty() || !analysis::is_of_frame(field))
      continue;  // the centre, and quantities that are measured in other ways
    const bool by_threshold = field.need == analysis::FrameNeed::threshold;
    if (!by_threshold) found.push_back({field, "", field.values(frame, 0)});
    for (std::size_t f = 0; by_threshold && f < frame.thresholds.size(); ++f)
      found.push_back({field, analysis::threshold_ending(frame.factors[f]), field.values(frame, f)});
  }
  for (const OwnQuantity& own : frame.frame.own)
    if (own.of_grains == of_grains) found.push_back({analysis::row_of(own), "", own.values});
  return found;
}

}  // namespace

std::vector<FieldColumn> grain_columns(const analysis::GrainSource& frame) {
  return columns(analysis::grain_quantities(), frame, true);
}

std::vector<FieldColumn> contact_columns(const analysis::GrainSource& frame) {
  return columns(analysis::contact_quantities(), frame, false);
}

std::vector<std::string> component_names(const FieldColumn& column) {
  std::vector<std::string> names = analysis::component_names(column.field);
  for (std::string& name : names) name += column.ending;
  return names;
}

pictures::MapExtent bed_bounds(const analysis::GrainSource& source) {
  pictures::MapExtent bounds = pictures::bed_extent(source.statics);
  pictures::extend(bounds, source);
  return bounds;
}

namespace {

/// Returns the name in extended XYZ by which OVITO recognises the quantity.
std::string xyz_name(const FieldColumn& column) {
  const std::string_view name = foreign_names(column.field).xyz;
  return name.empty() ? column.name() : std::string(name);
}

/// Returns the names of the components in a LAMMPS dump, separated by blanks.
std::string lammps_names(const FieldColumn& column) {
  const std::string_view names = foreign_names(column.field).lammps;
  return names.empty() ? joined(component_names(column), " ") : std::string(names);
}

/// Returns the number of components: three for vectors, four for tensors.
std::size_t width_of(const analysis::FrameQuantity& field) {
  return field.shape == analysis::FieldShape::vector ? 3 : analysis::components(field);
}

/// Returns names, types and numbers of columns: "pos:R:3:radius:R:1".
std::string properties(const std::vector<FieldColumn>& columns) {
  std::string text = "species:S:1:pos:R:3";
  for (const FieldColumn& column : columns)
    text += fmt::format(":{}:{}:{}", xyz_name(column),
                        column.field.number == analysis::FieldNumber::integer ? 'I' : 'R',
                        width_of(column.field));
  return text;
}

std::string box_line(const analysis::GrainSource& source, const std::vector<FieldColumn>& columns) {
  const pictures::MapExtent bounds = bed_bounds(source);
  const double d = source.statics.mean_diameter;
  return fmt::format(
      "Lattice=\"{} 0 0 0 {} 0 0 0 {}\" Origin=\"{} {} {}\" Properties={} pbc=\"{} F F\" Time={} tilt={} "
      "step={} frame={} mean_diameter={} units=\"lengths in mean diameters; all else SI, per metre of "
      "thickness\"\n",
      (bounds.x_max - bounds.x_min) / d, (bounds.y_max - bounds.y_min) / d, 1.0, bounds.x_min / d,
      bounds.y_min / d, -0.5, properties(columns), source.statics.periodic ? 'T' : 'F', source.frame.time,
      source.frame.tilt, source.frame.step, source.number, d);
}

void append_column(std::string& text, const FieldColumn& column, std::size_t row, double mean_diameter) {
  const std::size_t width = analysis::components(column.field);
  const bool is_length = column.field.unit == "m";
  for (std::size_t c = 0; c < width; ++c) {
    const double value = column.values[row * width + c];
    text += ' ';
    analysis::append_number(text, is_length ? value / mean_diameter : value,
                            is_length ? analysis::FieldNumber::real : column.field.number);
  }
  if (column.field.shape == analysis::FieldShape::vector) text += " 0";
}

}  // namespace

std::string xyz_text(const analysis::GrainSource& source) {
  const double d = source.statics.mean_diameter;
  const std::vector<FieldColumn> columns = grain_columns(source);
  std::string text = fmt::format("{}\n{}", source.frame.grain_count(), box_line(source, columns));
  for (std::size_t i = 0; i < source.frame.x.size(); ++i) {
    text += fmt::format("X {} {} 0", source.frame.x[i] / d, source.frame.y[i] / d);
    for (const FieldColumn& column : columns) append_column(text, column, i, d);
    text += '\n';
  }
  return text;
}

namespace {

void append_column(std::string& text, const FieldColumn& column, std::size_t row) {
  const std::size_t width = analysis::components(column.field);
  for (std::size_t c = 0; c < width; ++c) {
    analysis::append_number(text, column.values[row * width + c], column.field.number);
    text += ' ';
  }
}

void append_centre(std::string& text, const Frame& frame, std::size_t i) {
  for (const double coordinate : {frame.x[i], frame.y[i]}) {
    analysis::append_number(text, coordinate, analysis::FieldNumber::single);
    text += ' ';
  }
}

std::string head(const analysis::GrainSource& source, std::span<const FieldColumn> columns) {
  const double half = 0.5 * source.statics.mean_diameter;
  const pictures::MapExtent bounds = bed_bounds(source);
  return fmt::format(
      "ITEM: TIME\n{}\nITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\n"
      "ITEM: BOX BOUNDS {} ff ff\n{} {}\n{} {}\n{} {}\nITEM: ATOMS {} x y {}\n",
      source.frame.time, source.frame.step, source.frame.grain_count(), source.statics.periodic ? "pp" : "ff",
      bounds.x_min, bounds.x_max, bounds.y_min, bounds.y_max, -half, half,
      joined(columns.first(columns_before_centre), " ", lammps_names),
      joined(columns.subspan(columns_before_centre), " ", lammps_names));
}

}  // namespace

std::string lammps_dump_text(const analysis::GrainSource& source) {
  const std::vector<FieldColumn> columns = grain_columns(source);
  std::string text = head(source, columns);
  for (std::size_t i = 0; i < source.frame.x.size(); ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (k == columns_before_centre) append_centre(text, source.frame, i);
      append_column(text, columns[k], i);
    }
    text.back() = '\n';
  }
  return text;
}

}  // namespace talus::exports
