#pragma once
/// What follows an option is called by what it means, or by its unit, and not by how the parser stores it.

#include <CLI/CLI.hpp>
#include <string>

namespace talus::app {

/// Gives the options of all commands below `app` their words, which help, man pages, completions and messages
/// show: "DEG" for an angle in degrees, "FOLDER", "LOW,HIGH".
void name_values(CLI::App& app);

}  // namespace talus::app
