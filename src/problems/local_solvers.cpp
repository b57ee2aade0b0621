#include "problems/local_solvers.h"

#include <algorithm>
#include <cmath>

#include "solver/local_problem.h"
#include "solver/sweep.h"

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

namespace {

/// Sums of squares over the contacts.
struct Sums {
  double distance = 0.0;
  double impulse = 0.0;
  double velocity = 0.0;
  double free_velocity = 0.0;

  double error() const {
    const double scale = std::sqrt(std::max({impulse, velocity, free_velocity}));
    return scale > 0.0 ? std::sqrt(distance) / scale : 0.0;
  }
};

/// Returns the nearest point of the cone |P_t| <= mu P_n.
solver::Impulse nearest_in_cone(double pn, double pt, double mu) {
  const double tangential = std::fabs(pt);
  if (mu * tangential <= -pn) return {};
  if (tangential <= mu * pn) return {pn, pt};
  const double normal = (mu * tangential + pn) / (mu * mu + 1.0);
  return {normal, std::copysign(mu * normal, pt)};
}

void add_contact(Sums& sums, solver::Impulse p, solver::RelativeVelocity u, solver::RelativeVelocity q,
                 double mu) {
  const solver::Impulse projected =
      nearest_in_cone(p.normal - (u.normal + mu * std::fabs(u.tangential)), p.tangential - u.tangential, mu);
  const double dn = p.normal - projected.normal;
  const double dt = p.tangential - projected.tangential;
  sums.distance += dn * dn + dt * dt;
  sums.impulse += p.normal * p.normal + p.tangential * p.tangential;
  sums.velocity += u.normal * u.normal + u.tangential * u.tangential;
  sums.free_velocity += q.normal * q.normal + q.tangential * q.tangential;
}

}  // namespace

double siconos_error(const solver::LocalProblem& problem, const std::vector<solver::Impulse>& p) {
  Sums sums;
  for (Index c = 0; c < problem.contact_count(); ++c)
    add_contact(sums, p[c], solver::relative_velocity(problem, p, c), problem.q[c], problem.mu[c]);
  return sums.error();
}

double siconos_error(const solver::ContactProblem& problem, const solver::ContactSolution& solution) {
  Sums sums;
  for (Index c = 0; c < problem.contact_count(); ++c)
    add_contact(sums, {solution.pn[c], solution.pt[c]}, solver::relative_velocity(problem, solution, c),
                solver::free_relative_velocity(problem, c), problem.mu[c]);
  return sums.error();
}

}  // namespace talus::problems
