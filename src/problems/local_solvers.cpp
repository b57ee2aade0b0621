#include "problems/local_solvers.h"

#include <algorithm>
#include <cmath>

#include "solver/local_law.h"
#include "solver/momentum.h"

namespace talus::problems {
namespace {

struct LocalSums {
  double change = 0.0;   ///< || P_new - Y ||^2
  double impulse = 0.0;  ///< || P_new ||^2
  double ascent =
      0.0;  ///< (Y - P_new) . D (P_new - P), D the diagonal of W; positive if the momentum points uphill

  double relative_change() const { return impulse > 0.0 ? std::sqrt(change / impulse) : 0.0; }
};

/// Makes one sweep over all contacts in their order, each solved exactly for the current impulses; turns Y
/// into P_new. `p` is P.
LocalSums sweep(const solver::LocalProblem& problem, const std::vector<solver::LocalContact>& contacts,
                const std::vector<solver::Impulse>& p, std::vector<solver::Impulse>& y) {
  LocalSums sums;
  for (Index c = 0; c < problem.contact_count(); ++c) {
    const solver::LocalContact& contact = contacts[c];
    const solver::Impulse from = y[c];
    const solver::Impulse to =
        solver::solve_local_contact(contact, from, solver::relative_velocity(problem, y, c));
    const double dn = to.normal - from.normal;
    const double dt = to.tangential - from.tangential;
    sums.change += dn * dn + dt * dt;
    sums.impulse += to.normal * to.normal + to.tangential * to.tangential;
    sums.ascent -=
        contact.w.nn * dn * (to.normal - p[c].normal) + contact.w.tt * dt * (to.tangential - p[c].tangential);
    y[c] = to;
  }
  return sums;
}

/// Replaces P by P_new, which is in Y, and Y by P_new + beta (P_new - P).
void extrapolate(double beta, std::vector<solver::Impulse>& p, std::vector<solver::Impulse>& y) {
  for (std::size_t c = 0; c < p.size(); ++c) {
    const solver::Impulse before = p[c];
    p[c] = y[c];
    y[c].normal += beta * (p[c].normal - before.normal);
    y[c].tangential += beta * (p[c].tangential - before.tangential);
  }
}

solver::Residual evaluate(const solver::LocalProblem& problem, solver::LocalSolution& solution) {
  solver::velocities_from_impulses(problem, solution);
  return solver::natural_map_residual(problem, solution);
}

}  // namespace

solver::SolverReport solve(const solver::LocalProblem& problem, const solver::SolverSettings& settings,
                           solver::LocalSolution& solution) {
  const std::vector<solver::LocalContact> contacts = solver::local_contacts(problem);
  std::vector<solver::Impulse>& p = solution.p;
  std::vector<solver::Impulse> y = p;
  solver::Momentum momentum;
  solver::SolverReport report;
  report.residual = evaluate(problem, solution);
  // The residual costs as much as a sweep, so it is not computed after each of them.
  while (report.residual.eta > settings.tolerance && report.iterations < settings.max_iterations) {
    const int next_look = std::min(settings.max_iterations, report.iterations + 5 + report.iterations / 16);
    for (; report.iterations < next_look; ++report.iterations) {
      const LocalSums sums = sweep(problem, contacts, p, y);
      if (settings.kind == solver::SolverKind::accelerated)
        momentum.update(sums.relative_change(), sums.ascent);
      extrapolate(momentum.beta, p, y);
    }
    report.residual = evaluate(problem, solution);
  }
  report.converged = report.residual.eta <= settings.tolerance;
  return report;
}

}  // namespace talus::problems
