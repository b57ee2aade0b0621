#pragma once
/// The options of maps, which `talus render`, `animate`, `panel` and `run --pictures` share.

#include <CLI/CLI.hpp>
#include <string>

#include "pictures/map_plan.h"

namespace talus::app {

/// What of them a command has.
enum class MapOptionSet {
  drawn_live,  ///< --map, --width, --theta-c, --l-min, --colours, --context
  all,
};

/// RUN: the run to draw.
void add_run_argument(CLI::App& command, std::string& run);

/// In the group "Maps" of the help. `needs`: the option without which they have no meaning, if any.
void add_map_options(CLI::App& command, pictures::MapOptions& options, MapOptionSet set,
                     CLI::Option* needs = nullptr);

}  // namespace talus::app
