#pragma once
/// Which frame of one run belongs to a frame of another.

#include <optional>
#include <vector>

#include "view/plots.h"

namespace talus::view {

/// What two runs are compared by: their frames, those of a flow after failure last.
struct RunInstants {
  std::vector<double> tilts;   ///< rad, of all frames
  std::vector<double> times;   ///< s, of the same
  std::size_t tilt_count = 0;  ///< how many of them, the first, are of the tilt
  double theta_c = not_known;  ///< rad
};

/// The frame of `other` that is nearest on a clock, as far as its frames go, to an instant (rad, s) of
/// `shown`: by the tilt, by the angle that is left to failure, or by the time since the first frame; the
/// first of several that are as near. By an angle a frame of the flow of `shown` belongs to one of the flow
/// of `other`, by the time since the last frame of the tilt, where it has any. None where `other` has no
/// frames, or the clock is the angle left and not both have failed.
struct Instant {
  double tilt = 0.0, time = 0.0;
  bool in_flow = false;
};
std::optional<std::size_t> linked_frame(PlotAxis clock, const RunInstants& shown, const Instant& at,
                                        const RunInstants& other);

}  // namespace talus::view
