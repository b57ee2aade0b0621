#pragma once
/// The command line that draws what the view shows.

#include <optional>
#include <string>

#include "pictures/maps.h"

namespace talus::view {

/// What is shown, as far as `talus render` has options for it.
struct RenderRequest {
  std::string run;                          ///< path
  pictures::MapSettings settings;           ///< theta_c, where it is assumed, goes into the command
  double tilt = 0.0;                        ///< rad, of a frame of the run
  std::optional<std::size_t> frame;         ///< its number, where its tilt does not tell it from others
  bool in_flow = false;                     ///< the frame comes after failure: all of the flow is asked for
  std::optional<double> since;              ///< rad
  std::optional<pictures::MapExtent> part;  ///< m; without: the whole bed
  double mean_diameter = 1.0;               ///< m
};

/// "talus render RUN --map gamma --at 12.25": with an option for each setting that the map depends on and
/// that is not the default; as a shell reads it.
std::string render_command_line(const RenderRequest& shown);

}  // namespace talus::view
