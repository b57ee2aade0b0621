#pragma once
/// Volume of periodic beds over tilt, and theta_d by each estimator (paper, section VI).

#include <optional>
#include <span>

#include "figures/figure.h"
#include "figures/run_group.h"

namespace talus {

/// Volume strain over tilt, from the free surface and from the centre of mass (paper, Fig. 14).
std::optional<Figure> volume_strain_figure(std::span<const RunGroup> groups);

}  // namespace talus
