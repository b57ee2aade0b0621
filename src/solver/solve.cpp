#include "solver/solve.h"

#include "solver/problem.h"

namespace talus::solver {

namespace {

void push(const ContactProblem& problem, ContactSolution& solution, Index body, double fx, double fy,
          double torque) {
  solution.vx[body] += problem.inverse_mass[body] * fx;
  solution.vy[body] += problem.inverse_mass[body] * fy;
  solution.omega[body] += problem.inverse_inertia[body] * torque;
}

/// Solves the rolling impulse of a contact for the velocities that result from its forces (T40).
void solve_rolling_of(const ContactProblem& problem, Index c, ContactSolution& solution) {
  const double pr =
      solve_rolling(solution.pr[c], rolling_velocity(problem, solution, c),
                    inverse_rolling_delassus(problem, c), problem.rolling_friction[c], solution.pn[c]);
  const double moment = rolling_length(problem, c) * (pr - solution.pr[c]);
  push(problem, solution, problem.a[c], 0.0, 0.0, -moment);
  push(problem, solution, problem.b[c], 0.0, 0.0, moment);
  solution.pr[c] = pr;
}

}  // namespace

void gauss_seidel_sweep(const ContactProblem& problem, ContactSolution& solution) {
  for (Index c = 0; c < problem.contact_count(); ++c) {
    const DelassusDiagonal w = delassus_diagonal(problem, c);
    const RelativeVelocity u = relative_velocity(problem, solution, c);
    const Impulse p = solve_contact(solution.pn[c], solution.pt[c], u.normal, u.tangential, 1.0 / w.normal,
                                    1.0 / w.tangential, problem.mu[c]);
    const double dn = p.normal - solution.pn[c];
    const double dt = p.tangential - solution.pt[c];
    const double fx = dn * problem.nx[c] - dt * problem.ny[c];
    const double fy = dn * problem.ny[c] + dt * problem.nx[c];
    const Index a = problem.a[c];
    const Index b = problem.b[c];
    push(problem, solution, a, -fx, -fy, -problem.lever[a] * dt);
    push(problem, solution, b, fx, fy, -problem.lever[b] * dt);
    solution.pn[c] = p.normal;
    solution.pt[c] = p.tangential;
    if (problem.resists_rolling()) solve_rolling_of(problem, c, solution);
  }
}

namespace {

/// Sweeps until the residual reaches the tolerance; returns the number of sweeps. The residual costs as much
/// as a sweep, so it is computed after every tenth sweep only.
int solve_gauss_seidel(const ContactProblem& problem, const SolverSettings& settings,
                       ContactSolution& solution) {
  constexpr int sweeps_between_checks = 10;
  velocities_from_impulses(problem, solution);
  int sweeps = 0;
  while (sweeps < settings.max_iterations) {
    if (sweeps % sweeps_between_checks == 0 &&
        natural_map_residual(problem, solution).eta <= settings.tolerance)
      break;
    gauss_seidel_sweep(problem, solution);
    ++sweeps;
  }
  velocities_from_impulses(problem, solution);  // removes the round-off of many sweeps
  return sweeps;
}

}  // namespace

ThreadTeam* solver_team(const ContactProblem& problem, const SolverSettings& settings,
                        SolverWorkspace& workspace) {
  if (settings.kind != SolverKind::accelerated) return nullptr;
  return solver_team(problem, settings.threads, workspace.accelerated);
}

SolverReport solve(const ContactProblem& problem, const SolverSettings& settings, SolverWorkspace& workspace,
                   ContactSolution& solution) {
  SolverReport report;
  switch (settings.kind) {
    case SolverKind::gauss_seidel:
      report.iterations = solve_gauss_seidel(problem, settings, solution);
      report.residual = natural_map_residual(problem, solution);
      break;
    case SolverKind::accelerated: {
      const AcceleratedOutcome outcome =
          solve_accelerated(problem, settings.tolerance, settings.max_iterations, settings.threads,
                            workspace.accelerated, solution);
      report.iterations = outcome.iterations;
      report.residual = outcome.residual;
      break;
    }
  }
  report.converged = report.residual.eta <= settings.tolerance * (1.0 + 1e-9);
  return report;
}

}  // namespace talus::solver
