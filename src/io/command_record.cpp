#include <algorithm>

#include "io/run_records.h"

namespace talus {
namespace {

const std::string here = "/commands/";

CommandKind kind_of(const hdf5::Reader& reader, std::int8_t value) {
  if (value < 0 || value >= command_kind_count)
    reader.refuse(here + "kind", "holds another value than 0 ... 3");
  return static_cast<CommandKind>(value);
}

}  // namespace

void write_commands(hdf5::Writer& writer, const std::vector<Command>& commands) {
  if (commands.empty()) return;
  std::vector<std::int64_t> step;
  std::vector<std::int8_t> kind;
  std::vector<Index> grain;
  std::vector<double> x, y;
  for (const Command& command : commands) {
    step.push_back(command.step);
    kind.push_back(static_cast<std::int8_t>(command.kind));
    grain.push_back(command.grain);
    x.push_back(command.x);
    y.push_back(command.y);
  }
  writer.write(here + "step", step);
  writer.write(here + "kind", kind);
  writer.write(here + "grain", grain);
  writer.write(here + "x", x);
  writer.write(here + "y", y);
}

std::vector<Command> read_commands(hdf5::Reader& reader) {
  if (!reader.has("/commands")) return {};
  const auto step = reader.read<std::int64_t>(here + "step");
  const auto kind = reader.read<std::int8_t>(here + "kind");
  const auto grain = reader.read<Index>(here + "grain");
  const auto x = reader.read_finite(here + "x");
  const auto y = reader.read_finite(here + "y");
  if (!std::ranges::is_sorted(step) || (!step.empty() && step.front() < 0))
    reader.refuse(here + "step", "does not ascend from 0");
  std::vector<Command> commands;
  for (std::size_t k = 0; k < step.size(); ++k)
    commands.push_back({step[k], kind_of(reader, kind[k]), grain[k], x[k], y[k]});
  return commands;
}

}  // namespace talus
