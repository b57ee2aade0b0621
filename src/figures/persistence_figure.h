#pragma once
/// How the network of contact forces hangs together, and how that changes over tilt.

#include <optional>
#include <span>

#include "figures/figure.h"
#include "figures/run_group.h"

namespace talus {

/// Of one bed: the persistence diagrams of its force network at the start and just before failure, and over
/// tilt the total persistence and the distance of the diagrams of each two frames in a row.
std::optional<Figure> persistence_figure(std::span<const RunGroup> groups);

}  // namespace talus
