#include "solver/residual.h"

#include <cmath>

namespace talus {

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
    sums.add(p, solve_contact(p.normal, p.tangential, u.normal, u.tangential, 1.0 / w.normal,
                              1.0 / w.tangential, problem.mu[c]));
  }
  return sums.residual();
}

}  // namespace talus
