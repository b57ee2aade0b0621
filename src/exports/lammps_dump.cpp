#include <fmt/core.h>
#include <span>
#include <vector>

#include "base/text.h"
#include "exports/fields.h"
#include "exports/writers.h"

namespace talus::exports {
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
  const BedBounds bounds = bed_bounds(source);
  return fmt::format(
      "ITEM: TIME\n{}\nITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\n"
      "ITEM: BOX BOUNDS {} ff ff\n{} {}\n{} {}\n{} {}\nITEM: ATOMS {} x y {}\n",
      source.frame.time, source.frame.step, source.frame.grain_count(), source.statics.periodic ? "pp" : "ff",
      bounds.x_low, bounds.x_high, bounds.y_low, bounds.y_high, bounds.z_low, bounds.z_high,
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
