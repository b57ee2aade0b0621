#pragma once
/// [[command]]: the commands that a scenario gives to its run, and what a command may say.

#include <string>
#include <string_view>
#include <vector>

#include "scenario/key.h"
#include "scenario/scenario.h"

namespace talus::scenario {

/// The largest number of commands in a scenario.
inline constexpr std::size_t max_commands = 1000;
/// The largest coefficient of friction that a command can set.
inline constexpr double largest_friction = 10.0;

using CommandKey = Key<ScriptedCommand>;

/// The keys of a command, in the order in which they are written; `section` is what messages call it.
std::vector<CommandKey> command_keys(const std::string& section = "command");

/// "command.2": what settings and messages call the command with this index, counted from 1.
std::string command_section(std::size_t index);

/// Whether a command of this kind has a key besides its kind and its angle or time.
bool takes_key(CommandKind kind, std::string_view name);

/// What is wrong with a table that has these keys, to go on after its name: "has no kind: expected ...";
/// empty where nothing is.
std::string table_fault(const ScriptedCommand& command, const std::vector<std::string>& given,
                        const Scenario& scenario);

/// The command as a run records it; its step is not known yet.
Command command_of(const ScriptedCommand& command);

/// "at 12 deg", "3 s after the tilt began".
std::string moment_text(const ScriptedCommand& command);

/// What a command says that cannot be done to a bed of this scenario with so many free grains, with what was
/// expected: "grain 900, expected a free grain, 0 ... 799"; empty where nothing is wrong. Speeds are below
/// 100 sqrt(g D), counts 1 ... 1000, heights 0 ... 100 D, frictions 0 ... 10, rates 0 (the tilt is held) ...
/// 100 deg/s; between walls x of a drop lies on the bed.
std::string command_fault(const Command& command, const Scenario& scenario, Index free_count);

}  // namespace talus::scenario
