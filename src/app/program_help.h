#pragma once
/// What the program says of itself.

#include <CLI/CLI.hpp>
#include <string>

namespace talus::app {

/// Version, compiler, what is built in, and the versions of files that it reads and writes.
std::string version_report();

/// Adds the hidden command `program-help`, by which the build makes the man pages and the completions of
/// shells. The commands before it are those that it describes.
void add_program_help_command(CLI::App& app);

}  // namespace talus::app
