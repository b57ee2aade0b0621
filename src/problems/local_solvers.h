#pragma once
/// Solvers of problems given by W, q and mu only, plain sequential code on block rows; and the error measure
/// of Siconos, for comparison.

#include "solver/local_problem.h"
#include "solver/solve.h"

namespace talus::problems {

/// Solves a problem from the first guess in `solution.p`, as solve() does for a problem with bodies.
/// Gauss-Seidel visits the contacts in their order; the accelerated solver adds Nesterov's momentum to its
/// sweeps. A sweep has no step length, so neither method depends on the spectrum of W. `settings.threads` is
/// not used.
solver::SolverReport solve(const solver::LocalProblem& problem, const solver::SolverSettings& settings,
                           solver::LocalSolution& solution);

/// Returns || P - proj_K(P - (U + mu |U_t| n)) || / max(|| P ||, || U ||, || q ||) with the friction cones
/// K = { |P_t| <= mu P_n } and the orthogonal projection (De Saxce and Feng 1998; fc2d_compute_error of
/// Siconos 4.4, relative to the largest of the three norms). It vanishes exactly at a solution. It adds N s
/// to m/s and thus depends on the units: compare it within one problem only. Velocities are computed from the
/// impulses.
double siconos_error(const solver::LocalProblem& problem, const std::vector<solver::Impulse>& p);

/// Returns the same in one pass over the contacts, from the velocities in `solution`, which must belong to
/// its impulses.
double siconos_error(const solver::ContactProblem& problem, const solver::ContactSolution& solution);

}  // namespace talus::problems
