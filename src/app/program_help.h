#pragma once
/// Information about the program itself.

#include <CLI/CLI.hpp>
#include <string>

namespace talus::app {

/// Returns version, compiler, optional features, and the versions of the files that it reads and writes.
std::string version_report();

/// Adds the hidden command `program-help`, which the build uses to make man pages and shell completions. It
/// describes the commands added before it.
void add_program_help_command(CLI::App& app);

}  // namespace talus::app
