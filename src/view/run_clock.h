#pragma once
/// Correspondence between the frames of two runs.

#include <optional>
#include <vector>

#include "view/plots.h"

namespace talus::view {

/// Instants by which two runs are compared: those of their frames, with frames of a flow after failure last.
struct RunInstants {
  std::vector<double> tilts;   ///< rad, one per frame
  std::vector<double> times;   ///< s, one per frame
  std::size_t tilt_count = 0;  ///< number of frames of the tilt, which come first
  double theta_c = not_known;  ///< rad
};

/// Returns the frame of `other` that is nearest to an instant (rad, s) of `shown` on a clock: the tilt, the
/// angle left to failure, or the time since the first frame; among equally near frames, the first. With a
/// clock of angles, a frame of the flow of `shown` corresponds to a frame of the flow of `other`, if it has
/// any, by the time since the last frame of the tilt. Returns nothing if `other` has no frames, or if the
/// clock is the angle left and not both runs have failed.
struct Instant {
  double tilt = 0.0, time = 0.0;
  bool in_flow = false;
};
std::optional<std::size_t> linked_frame(PlotAxis clock, const RunInstants& shown, const Instant& at,
                                        const RunInstants& other);

}  // namespace talus::view
