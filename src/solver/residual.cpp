#include "solver/residual.h"

#include <algorithm>
#include <cmath>

#include "solver/contact_law.h"

namespace talus {

Residual natural_map_residual(const ContactProblem& problem, const ContactSolution& solution) {
  double change = 0.0;
  double impulse = 0.0;
  double impulse_after = 0.0;
  double largest = 0.0;
  for (Index c = 0; c < problem.contact_count(); ++c) {
    const DelassusDiagonal w = delassus_diagonal(problem, c);
    const RelativeVelocity u = relative_velocity(problem, solution, c);
    const double pn = solution.pn[c];
    const double pt = solution.pt[c];
    const Impulse after =
        local_solution(pn, pt, u.normal, u.tangential, 1.0 / w.normal, 1.0 / w.tangential, problem.mu[c]);
    const double dn = after.normal - pn;
    const double dt = after.tangential - pt;
    const double square = dn * dn + dt * dt;
    change += square;
    largest = std::max(largest, square);
    impulse += pn * pn + pt * pt;
    impulse_after += after.normal * after.normal + after.tangential * after.tangential;
  }
  const double scale = impulse > 0.0 ? impulse : impulse_after;
  if (!(scale > 0.0)) return {};
  return {std::sqrt(change / scale), std::sqrt(largest / scale)};
}

}  // namespace talus
