#pragma once
/// Options of maps, shared by `talus render`, `animate`, `panel` and `run --pictures`.

#include <CLI/CLI.hpp>
#include <string>

#include "pictures/map_plan.h"

namespace talus::app {

/// Subset of the map options that a command has.
enum class MapOptionSet {
  drawn_live,  ///< --map, --width, --theta-c, --l-min, --colours, --context
  all,
};

/// Adds the argument RUN, the run to draw.
void add_run_argument(CLI::App& command, std::string& run);

/// Adds options to the group "Maps" of the help. `needs`: the option that they require, if any.
void add_map_options(CLI::App& command, pictures::MapOptions& options, MapOptionSet set,
                     CLI::Option* needs = nullptr);

}  // namespace talus::app
