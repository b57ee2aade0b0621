#include <algorithm>

#include "io/record_fields.h"
#include "io/run_records.h"

namespace talus {
namespace {

const std::string here = "/commands/";

template <typename Commands, typename Fields>
void for_each_field(Commands& commands, Fields fields) {
  fields.column(here + "step", commands, &Command::step);
  fields.column(here + "kind", commands, &Command::kind);
  fields.column(here + "grain", commands, &Command::grain);
  fields.column(here + "x", commands, &Command::x);
  fields.column(here + "y", commands, &Command::y);
}

bool is_known(CommandKind kind) {
  const auto value = static_cast<std::int8_t>(kind);
  return value >= 0 && value < command_kind_count;
}

}  // namespace

void write_commands(hdf5::Writer& writer, const std::vector<Command>& commands) {
  if (!commands.empty()) for_each_field(commands, FieldWriter(writer));
}

std::vector<Command> read_commands(hdf5::Reader& reader) {
  std::vector<Command> commands;
  if (!reader.has("/commands")) return commands;
  for_each_field(commands, FieldReader(reader));
  if (!std::ranges::is_sorted(commands, {}, &Command::step) ||
      (!commands.empty() && commands.front().step < 0))
    reader.refuse(here + "step", "does not ascend from 0");
  if (!std::ranges::all_of(commands, is_known, &Command::kind))
    reader.refuse(here + "kind", "holds a value other than 0 ... 3");
  return commands;
}

}  // namespace talus
