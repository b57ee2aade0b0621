#pragma once
/// One call for all solvers.

#include "solver/accelerated.h"
#include "solver/problem.h"
#include "solver/residual.h"

namespace talus::solver {

enum class SolverKind {
  gauss_seidel,  ///< reference: nonlinear Gauss-Seidel in the order of the contacts
  accelerated,   ///< the same with Nesterov's momentum, vectorised and threaded
};

struct SolverSettings {
  SolverKind kind = SolverKind::accelerated;
  double tolerance = 1e-6;    ///< natural-map residual eta to reach
  int max_iterations = 5000;  ///< limit of iterations over all contacts
  int threads = 1;            ///< threads of the accelerated solver; the result does not depend on them
};

/// Outcome of a solve. A missed tolerance is a result, not an error.
struct SolverReport {
  int iterations = 0;  ///< iterations over all contacts
  Residual residual;
  bool converged = false;
};

/// Memory that a solver keeps between steps so that a steady step allocates nothing. The result of a solve
/// does not depend on earlier solves.
struct SolverWorkspace {
  AcceleratedWorkspace accelerated;
};

/// Returns the team that would solve this problem at present; null if one thread would, or if the solver has
/// no team.
ThreadTeam* solver_team(const ContactProblem& problem, const SolverSettings& settings,
                        SolverWorkspace& workspace);

/// Solves the problem, (T7) with (T9) and (T10), from the first guess in `solution` to the tolerance, and
/// judges the result by natural_map_residual. The same problem and guess give the same bits.
SolverReport solve(const ContactProblem& problem, const SolverSettings& settings, SolverWorkspace& workspace,
                   ContactSolution& solution);

}  // namespace talus::solver
