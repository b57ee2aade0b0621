#pragma once
/// Options of maps, shared by `talus render`, `animate`, `panel` and `run --pictures`; and --size, the size
/// of a picture, a movie or a window.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "pictures/map_options.h"
#include "scenario/key.h"

namespace talus::app {

/// The options as they were given.
struct MapArguments {
  pictures::MapOptions options;       ///< without those below
  std::string size;                   ///< syntax of parse_size; empty: the usual one
  std::vector<std::string> settings;  ///< "key=value", parameters of the maps
};

/// Subset of the map options that a command has.
enum class MapOptionSet {
  drawn_live,  ///< --map, --size, --colours, --context
  all,
};

/// Title of these options in the help, which describes them only on the page of `talus maps`.
inline constexpr const char* map_group = "Maps";

/// Adds the options. `needs`: the option that they require, if any.
void add_map_options(CLI::App& command, MapArguments& arguments, MapOptionSet set,
                     CLI::Option* needs = nullptr);

/// Returns the options with the size and the settings. Throws Error(usage), and as read_settings does.
pictures::MapOptions map_options(const MapArguments& arguments);

/// Returns the key of the width of coarse-grained fields, which maps and exports have.
scenario::KeyHead length_key();

/// Whether a setting "key=value" is a parameter of maps.
bool is_map_setting(const std::string& setting);

/// Returns the usual name of what is drawn of a run: RUN-maps for RUN, RUN.h5 and the folder RUN.h5.run, if
/// `ending` is "-maps".
std::string beside_run(const std::string& run, const std::string& ending);

/// A size as it was written: "1600", "1920x1080", "8.6cm" or "17.8x10cm".
struct WrittenSize {
  double width = 0.0, height = 0.0;  ///< px or cm; height 0: not given
  bool in_cm = false;
};

/// Parses a size. Throws Error(usage) if it is none of these forms, or has a fraction of a pixel.
WrittenSize parse_size(const std::string& text);

/// Sets the size of pictures; one in cm has the usual number of pixels. Throws Error(usage) if it is too
/// small or too large. An empty text keeps the usual size.
void set_size(pictures::MapOptions& options, const std::string& text);

}  // namespace talus::app
