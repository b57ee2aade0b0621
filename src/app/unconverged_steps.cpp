#include "app/unconverged_steps.h"

#include <algorithm>
#include <fmt/core.h>

namespace talus::app {

StepRemark remark_on(const session::SolverRecord& record, std::int64_t steps) {
  const std::int64_t missed =
      record.unconverged_deposition + record.unconverged_tilt + record.unconverged_flow;
  if (missed == 0) return {};
  const double share = static_cast<double>(missed) / static_cast<double>(std::max<std::int64_t>(1, steps));
  const bool usual = share <= usual_unconverged_share;
  const std::string text = fmt::format(
      "{:.2g} % of the steps did not reach their tolerance (largest residual {:.2g} at rest, {:.2g} while "
      "moving)",
      100.0 * share, record.residual_max_rest, record.residual_max_moving);
  if (usual) return {true, fmt::format("{}; this is usual (docs/solver.md).", text)};
  return {false, fmt::format("{}: {} in the deposition, {} in the tilt, {} after failure; up to {:g} % is "
                             "usual (docs/solver.md); raise solver.max_iterations",
                             text, record.unconverged_deposition, record.unconverged_tilt,
                             record.unconverged_flow, 100.0 * usual_unconverged_share)};
}

}  // namespace talus::app
