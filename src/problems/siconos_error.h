#pragma once
/// The error that Siconos reports for a frictional contact problem in two dimensions, for comparison.

#include "solver/local_problem.h"

namespace talus::problems {

/// || P - proj_K(P - (U + mu |U_t| n)) || / max(|| P ||, || U ||, || q ||) with the friction cones
/// K = { |P_t| <= mu P_n } and the projection orthogonal (De Saxce and Feng 1998; fc2d_compute_error of
/// Siconos 4.4, relative to the largest of the three norms). Zero exactly at a solution. It adds N s to m/s,
/// so it depends on the units: compare it within one problem only. Velocities are computed anew from the
/// impulses.
double siconos_error(const solver::LocalProblem& problem, const std::vector<solver::Impulse>& p);

/// The same in one pass over the contacts, from the velocities in `solution`, which must belong to its
/// impulses.
double siconos_error(const solver::ContactProblem& problem, const solver::ContactSolution& solution);

}  // namespace talus::problems
