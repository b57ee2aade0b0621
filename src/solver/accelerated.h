#pragma once
/// The accelerated solver: Gauss-Seidel sweeps with Nesterov's momentum (T16). Contacts are swept in groups
/// that share no body, so that a sweep vectorises and gives the same bits on any number of threads.

#include <exception>
#include <memory>

#include "base/thread_team.h"
#include "solver/linearisation.h"
#include "solver/problem.h"
#include "solver/residual.h"
#include "solver/team_choice.h"

namespace talus::solver {

/// Arrays and threads kept between solves. No result depends on them.
struct AcceleratedWorkspace {
  Linearisation linearisation;
  std::vector<SweepSums> sums;  ///< sums_of_part entries for each part of a sweep
  ContactSolution mean;         ///< mean of the last values of P0, without velocities
  std::unique_ptr<ThreadTeam> team;
  TeamChoice choice;           ///< choice between the team and its first member alone
  std::exception_ptr failure;  ///< exception of a member, rethrown by the caller of the team
};

struct AcceleratedOutcome {
  int iterations = 0;  ///< iterations over all contacts
  Residual residual;
};

/// Returns the team that would solve this problem at present; null if one thread would.
ThreadTeam* solver_team(const ContactProblem& problem, int threads, AcceleratedWorkspace& workspace);

/// Solves until the natural-map residual is at most `tolerance` or `max_iterations` have been made. Contacts
/// must be sorted by their first body. `solution` is as in solve(), and `threads` >= 1.
AcceleratedOutcome solve_accelerated(const ContactProblem& problem, double tolerance, int max_iterations,
                                     int threads, AcceleratedWorkspace& workspace, ContactSolution& solution);

}  // namespace talus::solver
