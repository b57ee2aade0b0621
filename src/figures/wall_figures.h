#pragma once
/// What walls do to the stress of a bed (paper, section IV).

#include <optional>
#include <span>

#include "figures/figure.h"
#include "figures/run_group.h"

namespace talus {

/// sigma_xx over x of the shortest bed between walls, at 0 and 10 deg and before failure (paper, Fig. 6).
std::optional<Figure> wall_stress_figure(std::span<const RunGroup> groups);

/// (sigma_T / sigma_N) / tan(theta) of a run, from its observables over the last `window` deg before
/// theta_c.
struct RatioAtFailure {
  double mean = 0.0;
  double spread = 0.0;  ///< standard deviation of the rows
};
RatioAtFailure ratio_at_failure(std::span<const ObservableRow> rows, double theta_c, double window);

/// That ratio over L, of all beds between walls, with the law of Eq. 15 (paper, Fig. 7).
std::optional<Figure> wall_ratio_figure(std::span<const RunGroup> groups);

}  // namespace talus
