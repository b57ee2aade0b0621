#include "solver/solve.h"

#include "solver/gauss_seidel.h"

namespace talus::solver {
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
