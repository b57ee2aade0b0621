#include "io/run_records.h"

namespace talus {
namespace {

template <typename Fields, typename Row>
void write_series(hdf5::Writer& writer, const std::string& group, const Fields& fields,
                  const std::vector<Row>& rows) {
  std::vector<double> column(rows.size());
  for (std::size_t f = 0; f < fields.size(); ++f) {
    for (std::size_t i = 0; i < rows.size(); ++i) column[i] = rows[i][f];
    writer.write(group + std::string(fields[f].name), column);
  }
}

template <typename Row, typename Fields>
std::vector<Row> read_series(hdf5::Reader& reader, const std::string& group, const Fields& fields) {
  std::vector<Row> rows;
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const std::string name(fields[f].name);
    const bool counts = name == "step" || name == "time" || name == "tilt" || name == "phase";
    const auto column = counts ? reader.read_finite(group + name) : reader.read<double>(group + name);
    rows.resize(column.size());
    for (std::size_t i = 0; i < column.size(); ++i) rows[i][f] = column[i];
  }
  return rows;
}

}  // namespace

void write_observables(hdf5::Writer& writer, const std::vector<ObservableRow>& rows) {
  write_series(writer, "/observables/", observable_fields, rows);
}

void write_steps(hdf5::Writer& writer, const std::vector<StepRow>& rows) {
  write_series(writer, "/steps/", step_fields, rows);
}

void write_trials(hdf5::Writer& writer, const std::vector<TrialRow>& rows) {
  if (!rows.empty()) write_series(writer, "/trials/", trial_fields, rows);
}

std::vector<TrialRow> read_trials(hdf5::Reader& reader) {
  if (!reader.has("/trials")) return {};
  return read_series<TrialRow>(reader, "/trials/", trial_fields);
}

std::vector<ObservableRow> read_observables(hdf5::Reader& reader) {
  return read_series<ObservableRow>(reader, "/observables/", observable_fields);
}

std::vector<StepRow> read_steps(hdf5::Reader& reader) {
  return read_series<StepRow>(reader, "/steps/", step_fields);
}

}  // namespace talus
