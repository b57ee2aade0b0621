#include <algorithm>

#include "io/record_fields.h"
#include "io/run_records.h"

namespace talus::io {
namespace {

template <typename Columns, typename Rows, typename Direction>
void for_each_column(const std::string& group, const Columns& columns, Rows& rows, Direction direction) {
  Fields fields{direction};
  for (std::size_t f = 0; f < columns.size(); ++f) {
    const std::string name(columns[f].name);
    const bool counts = name == "step" || name == "time" || name == "tilt" || name == "phase";
    const auto value = [f](auto& row) -> auto& { return row[f]; };
    fields.column(group + name, rows, value, counts ? Range{} : hdf5::any_number);
  }
}

template <typename Commands, typename Direction>
void for_each_command_column(Commands& commands, Direction direction) {
  Fields fields{direction};
  fields.column("/commands/step", commands, &Command::step, not_negative);
  fields.column("/commands/kind", commands, &Command::kind, Range{0.0, command_kind_count - 1.0});
  fields.column("/commands/grain", commands, &Command::grain);
  fields.column("/commands/x", commands, &Command::x);
  fields.column("/commands/y", commands, &Command::y);
}

}  // namespace

void write_observables(hdf5::Writer& writer, const std::vector<ObservableRow>& rows) {
  for_each_column("/observables/", observable_fields, rows, FileWriter{writer});
}

void write_steps(hdf5::Writer& writer, const std::vector<StepRow>& rows) {
  for_each_column("/steps/", step_fields, rows, FileWriter{writer});
}

void write_trials(hdf5::Writer& writer, const std::vector<TrialRow>& rows) {
  if (!rows.empty()) for_each_column("/trials/", trial_fields, rows, FileWriter{writer});
}

std::vector<TrialRow> read_trials(hdf5::Reader& reader) {
  std::vector<TrialRow> rows;
  if (reader.has("/trials")) for_each_column("/trials/", trial_fields, rows, FileReader{reader});
  return rows;
}

std::vector<ObservableRow> read_observables(hdf5::Reader& reader) {
  std::vector<ObservableRow> rows;
  for_each_column("/observables/", observable_fields, rows, FileReader{reader});
  return rows;
}

std::vector<StepRow> read_steps(hdf5::Reader& reader) {
  std::vector<StepRow> rows;
  for_each_column("/steps/", step_fields, rows, FileReader{reader});
  return rows;
}

void write_commands(hdf5::Writer& writer, const std::vector<Command>& commands) {
  if (!commands.empty()) for_each_command_column(commands, FileWriter{writer});
}

std::vector<Command> read_commands(hdf5::Reader& reader) {
  std::vector<Command> commands;
  if (!reader.has("/commands")) return commands;
  for_each_command_column(commands, FileReader{reader});
  if (!std::ranges::is_sorted(commands, {}, &Command::step))
    reader.refuse("/commands/step", "does not ascend");
  return commands;
}

}  // namespace talus::io
