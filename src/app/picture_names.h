#pragma once
/// What the pictures of a run are called.

#include "app/mapped_run.h"
#include "maps/frame_choice.h"

namespace talus {

/// A name for each chosen frame; names sort by time. The first `rising` of them are frames of the tilt and
/// carry its angle, gamma_012.00.png; the others are of the flow after failure and carry the time since the
/// last frame of the tilt, gamma_flow_002.3500s.png.
std::vector<std::string> picture_names(const MappedRun& run, const FrameChoice& choice, std::size_t rising,
                                       const std::string& map);

/// "gamma_012.00.png"; tilt in rad.
std::string tilt_name(const std::string& map, double tilt, int decimals);

/// "gamma_flow_002.3500s.png"; `time` in s since the last frame of the tilt.
std::string flow_name(const std::string& map, double time);

}  // namespace talus
