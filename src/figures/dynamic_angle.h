#pragma once
/// The dynamic angle of repose beside the angles that the paper expects it at.

#include <optional>
#include <span>

#include "figures/figure.h"
#include "figures/run_group.h"

namespace talus {

/// Angle at rest of each run over its theta_c and its theta_d by each estimator, and the first of these runs
/// over time. No value where no flow was followed until it stopped (tilt.after_failure).
std::optional<Figure> dynamic_angle_figure(std::span<const RunGroup> groups);

/// One run over time from shortly before failure on: tilt, and mean velocity of the surface layer between two
/// rows of observables.
Table flow_trace(const FigureRun& run);

}  // namespace talus
