#pragma once
/// The reference solver: nonlinear Gauss-Seidel (T15), plain and readable. Others are compared with it.

#include "solver/problem.h"

namespace talus::solver {

/// One sweep over all contacts in their order; each is solved exactly for the velocities of the moment, and
/// then its rolling impulse where it has one.
/// `solution` holds impulses and the velocities that belong to them, before and after.
void gauss_seidel_sweep(const ContactProblem& problem, ContactSolution& solution);

}  // namespace talus::solver
