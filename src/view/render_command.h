#pragma once
/// Command line that draws the picture shown.

#include <optional>
#include <string>

#include "pictures/maps.h"

namespace talus::view {

/// Picture shown, as far as `talus render` has options for it.
struct RenderRequest {
  std::string run;                          ///< path
  pictures::MapSettings settings;           ///< an assumed theta_c is written into the command
  double tilt = 0.0;                        ///< rad, tilt of a frame of the run
  std::optional<std::size_t> frame;         ///< number of the frame, if its tilt is not unique
  bool in_flow = false;                     ///< the frame comes after failure: the entire flow is requested
  std::optional<double> since;              ///< rad
  std::optional<pictures::MapExtent> part;  ///< m; empty: the entire bed
  double mean_diameter = 1.0;               ///< m
};

/// Returns "talus render RUN --map gamma --at 12.25", quoted for the shell, with an option for each setting
/// that the map depends on and that differs from the default.
std::string render_command_line(const RenderRequest& shown);

}  // namespace talus::view
