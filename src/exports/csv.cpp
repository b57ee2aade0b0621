#include <fmt/core.h>
#include <string_view>
#include <vector>

#include "base/text.h"
#include "exports/fields.h"
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

}  // namespace talus::exports
