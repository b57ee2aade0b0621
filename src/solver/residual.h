#pragma once
/// The one measure of error, for every solver.

#include "solver/problem.h"

namespace talus {

struct Residual {
  double eta = 0.0;      ///< || P' - P || / || P ||, dimensionless
  double largest = 0.0;  ///< the largest single contact's | P' - P | / || P ||
};

/// Natural-map residual: P' is what one exact local solution of every contact would make of P, all others
/// held (a Jacobi step). Zero exactly at a solution. Where P vanishes and P' does not, the norm of P' takes
/// its place. `solution` must hold impulses and the velocities that belong to them.
Residual natural_map_residual(const ContactProblem& problem, const ContactSolution& solution);

}  // namespace talus
