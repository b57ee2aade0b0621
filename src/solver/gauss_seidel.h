#pragma once
/// The reference solver: nonlinear Gauss-Seidel (T15), plain and readable. Tests compare others with it.

#include "solver/problem.h"

namespace talus::solver {

/// Makes one sweep over all contacts in their order. Each contact is solved exactly for the current
/// velocities, and then its rolling impulse, if it has one. `solution` holds impulses and the velocities that
/// belong to them, before and after.
void gauss_seidel_sweep(const ContactProblem& problem, ContactSolution& solution);

}  // namespace talus::solver
