#include "solver/residual.h"

#include <cmath>

namespace talus::solver {

Residual ResidualSums::residual() const {
  if (!(scale() > 0.0)) return {};
  return {std::sqrt(change / scale()), std::sqrt(largest / scale())};
}

Residual natural_map_residual(const ContactProblem& problem, const ContactSolution& solution) {
  ResidualSums sums;
  for (Index c = 0; c < problem.contact_count(); ++c) {
    const DelassusDiagonal w = delassus_diagonal(problem, c);
    const RelativeVelocity u = relative_velocity(problem, solution, c);
    const Impulse p{solution.pn[c], solution.pt[c]};
    const Impulse solved = solve_contact(p.normal, p.tangential, u.normal, u.tangential, 1.0 / w.normal,
                                         1.0 / w.tangential, problem.mu[c]);
    if (!problem.resists_rolling()) {
      sums.add(p, solved);
      continue;
    }
    sums.add(p, solved, solution.pr[c],
             solve_rolling(solution.pr[c], rolling_velocity(problem, solution, c),
                           inverse_rolling_delassus(problem, c), problem.rolling_friction[c], solved.normal));
  }
  return sums.residual();
}

}  // namespace talus::solver
