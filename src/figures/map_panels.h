#pragma once
/// Maps of a bed at growing tilt, one below the other (paper, Figs. 10 and 13).

#include <optional>
#include <span>
#include <vector>

#include "figures/figure.h"
#include "figures/run_group.h"
#include "pictures/frame_choice.h"

namespace talus {

/// The frames nearest to 0, 5, 10 and 15 deg, those of them that are there and come before theta_c (rad),
/// and the last one before theta_c. `tilts` as in frames_at.
FrameChoice panel_frames(const std::vector<double>& tilts, double theta_c);

/// Paper, Fig. 10: gamma in gray, of the first run that has failed.
std::optional<Figure> gamma_maps(std::span<const RunGroup> groups);

/// Paper, Fig. 13: overloaded grains in black, of the same run; a column for each threshold.
std::optional<Figure> overload_maps(std::span<const RunGroup> groups);

}  // namespace talus
