#include "app/unconverged_steps.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace talus {

StepRemark remark_on(const SolverRecord& record, std::int64_t steps) {
  const std::int64_t missed =
      record.unconverged_deposition + record.unconverged_tilt + record.unconverged_flow;
  if (missed == 0) return {};
  const double share = static_cast<double>(missed) / static_cast<double>(std::max<std::int64_t>(1, steps));
  const bool usual = share <= usual_unconverged_share;
  std::array<char, 256> text{};
  std::snprintf(
      text.data(), text.size(),
      "%.2g %% of the steps did not reach their tolerance (largest residual %.2g at rest, %.2g while "
      "moving)",
      100.0 * share, record.residual_max_rest, record.residual_max_moving);
  if (usual) return {true, std::string(text.data()) + "; so few are usual, see docs/solver.md"};
  return {false, std::string(text.data()) + ": " + std::to_string(record.unconverged_deposition) +
                     " of the deposition, " + std::to_string(record.unconverged_tilt) + " of the tilt, " +
                     std::to_string(record.unconverged_flow) +
                     " after failure; one or two in a hundred are usual (docs/solver.md), "
                     "solver.max_iterations gives them more passes"};
}

}  // namespace talus
