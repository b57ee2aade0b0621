#pragma once
/// Commands of a scenario ([[command]]), and the limits of commands.

#include <string>
#include <string_view>
#include <vector>

#include "scenario/key.h"
#include "scenario/scenario.h"

namespace talus::scenario {

/// Largest number of commands in a scenario.
inline constexpr std::size_t max_commands = 1000;
/// Largest coefficient of friction that a command can set.
inline constexpr double largest_friction = 10.0;

using CommandKey = Key<ScriptedCommand>;

/// Returns the keys of a command in the order in which they are written; `section` is its name in messages.
std::vector<CommandKey> command_keys(const std::string& section = "command");

/// Returns the name of the command with this index in settings and messages, counted from 1: "command.2".
std::string command_section(std::size_t index);

/// Whether a command of this kind has a key in addition to its kind and its angle or time.
bool takes_key(CommandKind kind, std::string_view name);

/// Describes the error in a table that has these keys, as a continuation of its name: "has no kind: expected
/// ..."; empty if there is no error.
std::string table_fault(const ScriptedCommand& command, const std::vector<std::string>& given,
                        const Scenario& scenario);

/// Returns the command in the form in which a run records it; its step is not set yet.
Command command_of(const ScriptedCommand& command);

/// Describes the time of a command: "at 12 deg", "3 s after the tilt began".
std::string moment_text(const ScriptedCommand& command);

/// Describes why a command cannot be applied to a bed of this scenario with `free_count` free grains, and
/// what was expected: "grain 900, expected a free grain, 0 ... 799"; empty if it can. Speeds are below 100
/// sqrt(g D), counts 1 ... 1000, heights 0 ... 100 D, friction coefficients 0 ... 10, and rates -100 ... 100
/// deg/s (0: the tilt is held). Between walls, x of a drop must lie on the bed.
std::string command_fault(const Command& command, const Scenario& scenario, Index free_count);

}  // namespace talus::scenario
