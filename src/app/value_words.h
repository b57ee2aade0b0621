#pragma once
/// Placeholders of option values, named by their meaning or unit instead of their type.

#include <CLI/CLI.hpp>
#include <string>

namespace talus::app {

/// Sets the placeholders of the options of all commands below `app`, which help, man pages, completions and
/// messages show: "DEG" for an angle in degrees, "FOLDER", "LOW,HIGH".
void name_values(CLI::App& app);

}  // namespace talus::app
