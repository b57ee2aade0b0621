#include <algorithm>
#include <fmt/core.h>

#include "io/record_fields.h"
#include "io/run_records.h"

namespace talus {
namespace {

template <typename Commands, typename Fields>
void for_each_column(Commands& commands, Fields fields) {
  fields.column("/commands/step", commands, &Command::step);
  fields.column("/commands/kind", commands, &Command::kind);
  fields.column("/commands/grain", commands, &Command::grain);
  fields.column("/commands/x", commands, &Command::x);
  fields.column("/commands/y", commands, &Command::y);
}

bool is_known(CommandKind kind) {
  const auto value = static_cast<std::int8_t>(kind);
  return value >= 0 && value < command_kind_count;
}

}  // namespace

void write_commands(hdf5::Writer& writer, const std::vector<Command>& commands) {
  if (!commands.empty()) for_each_column(commands, FieldWriter(writer));
}

std::vector<Command> read_commands(hdf5::Reader& reader) {
  std::vector<Command> commands;
  if (!reader.has("/commands")) return commands;
  for_each_column(commands, FieldReader(reader));
  if (!std::ranges::is_sorted(commands, {}, &Command::step) ||
      (!commands.empty() && commands.front().step < 0))
    reader.refuse("/commands/step", "does not ascend from 0");
  if (!std::ranges::all_of(commands, is_known, &Command::kind))
    reader.refuse("/commands/kind", fmt::format("holds a value other than 0 ... {}", command_kind_count - 1));
  return commands;
}

}  // namespace talus
