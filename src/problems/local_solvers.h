#pragma once
/// Solvers of problems of which only W, q and mu are known: plain sequential code on block rows.

#include "solver/local_problem.h"
#include "solver/solve.h"

namespace talus::problems {

/// As solve() for a problem with bodies, from the first guess in `solution.p`. Gauss-Seidel visits the
/// contacts in their order; the accelerated solver gives its sweeps Nesterov's momentum. A sweep needs no
/// step length, so neither depends on the spectrum of W. `settings.threads` is not used.
solver::SolverReport solve(const solver::LocalProblem& problem, const solver::SolverSettings& settings,
                           solver::LocalSolution& solution);

}  // namespace talus::problems
