#include "scenario/scripted_command.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "base/text.h"
#include "scenario/keys.h"
#include "scenario/text.h"

namespace talus::scenario {
namespace {

constexpr double fastest_push = 100.0;  // sqrt(g D)
constexpr Index max_dropped = 1000;     // grains
constexpr double highest_drop = 100.0;  // D
constexpr double fastest_tilt = 100.0;  // deg/s

std::string differs(const std::string& found, const std::string& expected) {
  return fmt::format("{}, expected {}", found, expected);
}

std::string range_fault(const char* name, double value, double highest, const char* unit) {
  if (value >= 0.0 && value <= highest) return {};  // false for NaN
  return differs(fmt::format("{} {:.4g}{}", name, value, unit), fmt::format("0 ... {:.4g}{}", highest, unit));
}

std::string grain_fault(const Command& command, Index free_count) {
  if (command.grain >= 0 && command.grain < free_count) return {};
  return differs(fmt::format("grain {}", command.grain),
                 fmt::format("a free grain, 0 ... {}", free_count - 1));
}

std::string push_fault(const Command& command, const Scenario& scenario, Index free_count) {
  const double limit = fastest_push * std::sqrt(gravity * scenario.grains.mean_diameter);
  const double speed = std::sqrt(command.x * command.x + command.y * command.y);
  if (std::string fault = grain_fault(command, free_count); !fault.empty() || speed < limit) return fault;
  return differs(fmt::format("speed {:.4g} m/s", speed),
                 fmt::format("less than 100 sqrt(g D) = {:.4g} m/s", limit));
}

std::string drop_fault(const Command& command, const Scenario& scenario) {
  const double diameter = scenario.grains.mean_diameter;
  if (command.grain < 1 || command.grain > max_dropped)
    return differs(fmt::format("{} grains", command.grain), fmt::format("1 ... {}", max_dropped));
  if (!std::isfinite(command.x))
    return differs(fmt::format("x = {:.4g} m", command.x), "a position on the bed");
  if (scenario.bed.boundary == BedBoundary::walls)
    if (std::string fault = range_fault("x =", command.x, scenario.bed.length * diameter, " m");
        !fault.empty())
      return fault;
  return range_fault("height", command.y, highest_drop * diameter, " m");
}

}  // namespace

std::vector<CommandKey> command_keys(const std::string& section) {
  using C = ScriptedCommand;
  const std::vector<std::string> kinds(command_kind_names.begin(), command_kind_names.end());
  const NumberRange any = from_to(-1e9, 1e9);
  std::vector<CommandKey> keys = {
      {{"at", "deg", from_to(-60.0, 60.0, "none"),
        "the command is carried out when the tilt first reaches this angle; below 0: on the opposite side"},
       &C::at},
      {{"time", "s", from_to(0.0, 1e6, "none"),
        "the same for the time since the tilt began; a command has an angle or a time"},
       &C::time},
      {{"kind", "", Choices{kinds}, "action of the command"}, &C::kind},
      {{"grain", "", IntegerRange{0, 2'000'000},
        "push, drag: number of the free grain; drop: number of grains of the free surface"},
       &C::grain},
      {{"x", "", any,
        "push: velocity added along the bed, m/s; drop: position along the bed, m; friction: the "
        "coefficient; tilt_rate: deg/s, below 0: downwards; drag: position of the spring along the bed, m"},
       &C::x},
      {{"y", "", any,
        "push: velocity added away from the floor, m/s; drop: height above the free surface, m; drag: height "
        "of the spring above the floor, m"},
       &C::y},
  };
  for (CommandKey& key : keys) key.section = section;
  return keys;
}

std::string command_section(std::size_t index) { return fmt::format("command.{}", index + 1); }

bool takes_key(CommandKind kind, std::string_view name) {
  using enum CommandKind;
  const bool sets_a_number = kind == friction || kind == tilt_rate;
  if (name == "x") return kind != release;
  return (name == "grain" || name == "y") && kind != release && !sets_a_number;
}

std::string table_fault(const ScriptedCommand& command, const std::vector<std::string>& given,
                        const Scenario& scenario) {
  const auto has = [&](const char* name) { return std::ranges::find(given, name) != given.end(); };
  if (has("at") && has("time")) return "has an angle and a time: expected at or time";
  if (!has("at") && !has("time"))
    return "has neither an angle nor a time: expected at = an angle in deg, or time = s since the tilt began";
  if (!has("kind"))
    return fmt::format("has no kind: expected kind = \"{}\"", joined(command_kind_names, "\" or \""));
  const std::string_view word = command_kind_names[static_cast<std::size_t>(command.kind)];
  for (const char* name : {"grain", "x", "y"}) {
    const bool takes = takes_key(command.kind, name);
    if (has(name) && !takes) return fmt::format("is \"{}\", which takes no {}", word, name);
    const bool half_a_push = command.kind == CommandKind::push && (has("x") || has("y"));
    if (!has(name) && takes && (!half_a_push || std::string_view(name) == "grain"))
      return fmt::format("is \"{}\", which needs {}", word, name);
  }
  const bool from_file = scenario.deposition.method == DepositionMethod::file;
  const double grains = from_file ? max_grains : std::round(scenario.bed.length * scenario.bed.depth);
  const std::string fault =
      command_fault(command_of(command), scenario, static_cast<Index>(std::min(grains, max_grains)));
  return fault.empty() ? fault : fmt::format("is \"{}\" with {}", word, fault);
}

Command command_of(const ScriptedCommand& command) {
  return {0, command.kind, command.grain, command.x, command.y};
}

std::string moment_text(const ScriptedCommand& command) {
  return command.at ? fmt::format("at {} deg", short_text(*command.at))
                    : fmt::format("{} s after the tilt began", short_text(command.time.value_or(0.0)));
}

std::string command_fault(const Command& command, const Scenario& scenario, Index free_count) {
  switch (command.kind) {
    case CommandKind::push:
      return push_fault(command, scenario, free_count);
    case CommandKind::drop:
      return drop_fault(command, scenario);
    case CommandKind::friction:
      return range_fault("coefficient", command.x, largest_friction, "");
    case CommandKind::tilt_rate:
      if (std::abs(command.x) <= fastest_tilt) return {};  // false for NaN
      return differs(fmt::format("rate {:.4g} deg/s", command.x),
                     fmt::format("-{0:g} ... {0:g} deg/s; 0 holds the tilt", fastest_tilt));
    case CommandKind::drag:
      return grain_fault(command, free_count);
    case CommandKind::release:
      break;
  }
  return {};
}

}  // namespace talus::scenario
