#pragma once
/// Impulses that hold bodies at rest. If all velocities vanish, any impulses in Coulomb's cones obey the
/// contact law, so all sets of impulses in balance solve the contact problem. They form a convex set
/// (McNamara and Herrmann 2004). The solvers of solve.h need not end in it: on a slope they may let bodies
/// move.

#include "solver/solve.h"

namespace talus::solver {

/// Searches, from the first guess in `solution`, for impulses of the closed contacts (c_n <= 0) that leave
/// the bodies no velocity. Minimises the kinetic energy of v = v_free + M^-1 H P over Coulomb's cones by
/// projected gradients with Nesterov's momentum, and so ends near the admissible set closest to the guess.
/// Velocities demanded by overlaps and restitution (c_n < 0, c_t) are ignored. The residual is that of
/// residual.h with the orthogonal projection on the cones. It vanishes at the minimum even if the bodies are
/// not held there; the velocities in `solution` show whether they are. The same input gives the same bits.
SolverReport balance(const ContactProblem& problem, double tolerance, int max_iterations,
                     ContactSolution& solution);

}  // namespace talus::solver
