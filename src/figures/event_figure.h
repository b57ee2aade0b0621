#pragma once
/// Rearrangements on the way to failure.

#include <optional>
#include <span>

#include "figures/figure.h"
#include "figures/run_group.h"

namespace talus {

/// Of the runs of each group together: their sizes and waiting angles with the laws of maximum likelihood,
/// and how large each is, and how it changes the volume, over the tilt. No value without a rearrangement.
std::optional<Figure> event_figure(std::span<const RunGroup> groups);

}  // namespace talus
