#pragma once
/// What walls do to the stress of a bed (paper, section IV).

#include <optional>
#include <span>

#include "figures/figure.h"
#include "figures/run_group.h"

namespace talus {

/// sigma_xx over x of the shortest bed between walls, at 0 and 10 deg and before failure (paper, Fig. 6).
std::optional<Figure> wall_stress_figure(std::span<const RunGroup> groups);

/// (sigma_T / sigma_N) / tan(theta) at failure over L, of all beds between walls, with the law of Eq. 15
/// (paper, Fig. 7).
std::optional<Figure> wall_ratio_figure(std::span<const RunGroup> groups);

}  // namespace talus
