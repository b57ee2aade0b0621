#pragma once
/// The mean stress of the packing over its tilt (paper, section IV).

#include <optional>
#include <span>

#include "figures/figure.h"
#include "figures/run_group.h"

namespace talus {

/// sigma_T / sigma_N over tan(theta), of all groups (paper, Fig. 4).
std::optional<Figure> shear_stress_figure(std::span<const RunGroup> groups);

/// Gamma over sin(theta), of all groups (paper, Fig. 5).
std::optional<Figure> stress_ratio_figure(std::span<const RunGroup> groups);

}  // namespace talus
