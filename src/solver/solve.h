#pragma once
/// All solvers behind one call.

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
  int max_iterations = 5000;  ///< over all contacts, at most
  int threads = 1;            ///< of the accelerated solver; the result does not depend on it
};

/// How a solve ended. Not reaching the tolerance is a result, not an error.
struct SolverReport {
  int iterations = 0;  ///< over all contacts
  Residual residual;
  bool converged = false;
};

/// Memory that a solver keeps between steps so that a steady step allocates nothing. The result
/// of a solve does not depend on what was solved before.
struct SolverWorkspace {
  AcceleratedWorkspace accelerated;
};

/// The team that would solve this problem at present; null where one thread does, or the solver has none.
ThreadTeam* team_at_hand(const ContactProblem& problem, const SolverSettings& settings,
                         SolverWorkspace& workspace);

/// Solves the problem, (T7) with (T9) and (T10), from the first guess in `solution` to the tolerance, and
/// judges the result by natural_map_residual. The same bits for the same problem and guess.
SolverReport solve(const ContactProblem& problem, const SolverSettings& settings, SolverWorkspace& workspace,
                   ContactSolution& solution);

}  // namespace talus::solver
