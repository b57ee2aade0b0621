#include "solver/problem.h"

#include <cmath>

namespace talus::solver {

namespace {

RelativeVelocity relative_velocity(const ContactProblem& problem, const std::vector<double>& vx,
                                   const std::vector<double>& vy, const std::vector<double>& omega, Index c) {
  const Index a = problem.a[c];
  const Index b = problem.b[c];
  const double nx = problem.nx[c];
  const double ny = problem.ny[c];
  const double dvx = vx[b] - vx[a];
  const double dvy = vy[b] - vy[a];
  const double spin = problem.lever[a] * omega[a] + problem.lever[b] * omega[b];
  return {dvx * nx + dvy * ny + problem.cn[c], dvy * nx - dvx * ny - spin + problem.ct[c]};  // (T5)
}

}  // namespace

RelativeVelocity relative_velocity(const ContactProblem& problem, const ContactSolution& at, Index c) {
  return relative_velocity(problem, at.vx, at.vy, at.omega, c);
}

RelativeVelocity free_relative_velocity(const ContactProblem& problem, Index c) {
  return relative_velocity(problem, problem.vx, problem.vy, problem.omega, c);
}

double rolling_length(const ContactProblem& problem, Index c) {
  return problem.lever[problem.a[c]] + problem.lever[problem.b[c]];
}

double inverse_rolling_delassus(const ContactProblem& problem, Index c) {
  const double length = rolling_length(problem, c);
  const double w =
      length * length * (problem.inverse_inertia[problem.a[c]] + problem.inverse_inertia[problem.b[c]]);
  return w > 0.0 ? 1.0 / w : 0.0;
}

double rolling_velocity(const ContactProblem& problem, const ContactSolution& at, Index c) {
  return rolling_length(problem, c) * (at.omega[problem.b[c]] - at.omega[problem.a[c]]);
}

void velocities_from_impulses(const ContactProblem& problem, ContactSolution& solution) {
  solution.vx = problem.vx;
  solution.vy = problem.vy;
  solution.omega = problem.omega;
  for (Index c = 0; c < problem.contact_count(); ++c) {
    const double fx = solution.pn[c] * problem.nx[c] - solution.pt[c] * problem.ny[c];
    const double fy = solution.pn[c] * problem.ny[c] + solution.pt[c] * problem.nx[c];
    for (const bool second : {false, true}) {  // (T6)
      const Index body = second ? problem.b[c] : problem.a[c];
      const double sign = second ? 1.0 : -1.0;
      solution.vx[body] += sign * problem.inverse_mass[body] * fx;
      solution.vy[body] += sign * problem.inverse_mass[body] * fy;
      solution.omega[body] -= problem.inverse_inertia[body] * problem.lever[body] * solution.pt[c];
    }
  }
  if (!problem.resists_rolling()) return;
  for (Index c = 0; c < problem.contact_count(); ++c) {  // (T39)
    const double moment = rolling_length(problem, c) * solution.pr[c];
    solution.omega[problem.a[c]] -= problem.inverse_inertia[problem.a[c]] * moment;
    solution.omega[problem.b[c]] += problem.inverse_inertia[problem.b[c]] * moment;
  }
}

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
