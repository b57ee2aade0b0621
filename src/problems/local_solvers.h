#pragma once
/// Solvers of problems given by W, q and mu only: plain sequential code on block rows.

#include "solver/local_problem.h"
#include "solver/solve.h"

namespace talus::problems {

/// Solves a problem from the first guess in `solution.p`, as solve() does for a problem with bodies.
/// Gauss-Seidel visits the contacts in their order; the accelerated solver adds Nesterov's momentum to its
/// sweeps. A sweep has no step length, so neither method depends on the spectrum of W. `settings.threads` is
/// not used.
solver::SolverReport solve(const solver::LocalProblem& problem, const solver::SolverSettings& settings,
                           solver::LocalSolution& solution);

}  // namespace talus::problems
