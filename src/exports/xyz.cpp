#include <fmt/core.h>
#include <vector>

#include "exports/fields.h"
#include "exports/writers.h"

namespace talus::exports {
namespace {

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
  const BedBounds bounds = bed_bounds(source);
  const double d = source.statics.mean_diameter;
  return fmt::format(
      "Lattice=\"{} 0 0 0 {} 0 0 0 {}\" Origin=\"{} {} {}\" Properties={} pbc=\"{} F F\" Time={} tilt={} "
      "step={} "
      "frame={} mean_diameter={} units=\"lengths in mean diameters; all else SI, per metre of thickness\"\n",
      (bounds.x_high - bounds.x_low) / d, (bounds.y_high - bounds.y_low) / d,
      (bounds.z_high - bounds.z_low) / d, bounds.x_low / d, bounds.y_low / d, bounds.z_low / d,
      properties(columns), source.statics.periodic ? 'T' : 'F', source.frame.time, source.frame.tilt,
      source.frame.step, source.number, d);
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

}  // namespace talus::exports
