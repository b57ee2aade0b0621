#pragma once
/// Impulses that hold bodies where they are. Where all velocities vanish any impulses in Coulomb's cones obey
/// the contact law, so all sets that balance solve the contact problem; they are a convex set (McNamara and
/// Herrmann 2004). The solvers of solve.h need not end in it: on a slope they may let bodies go.

#include "solver/solve.h"

namespace talus::solver {

/// Looks for impulses of the closed contacts (c_n <= 0) that leave the bodies no velocity, from the first
/// guess in `solution` on: minimises the kinetic energy of v = v_free + M^-1 H P over Coulomb's cones by
/// projected gradients with Nesterov's momentum, and so ends near the set closest to the guess. Demands of
/// overlaps and restitution (c_n < 0, c_t) are left out. The residual is that of residual.h with the
/// orthogonal projection on the cones: it vanishes at the minimum, whether bodies are held there or not,
/// which the velocities in `solution` tell. The same bits for the same input.
SolverReport balance(const ContactProblem& problem, double tolerance, int max_iterations,
                     ContactSolution& solution);

}  // namespace talus::solver
