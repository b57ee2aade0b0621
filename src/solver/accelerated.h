#pragma once
/// The accelerated solver: Gauss-Seidel sweeps with Nesterov's momentum (T16), in groups of contacts that
/// share no body, so that a sweep vectorises and runs on any number of threads with the same bits.

#include <exception>
#include <memory>

#include "base/thread_team.h"
#include "solver/linearisation.h"
#include "solver/problem.h"
#include "solver/residual.h"
#include "solver/team_choice.h"

namespace talus::solver {

/// Arrays and threads kept between solves; no state that a result depends on.
struct AcceleratedWorkspace {
  Linearisation linearisation;
  std::vector<SweepSums> sums;  ///< sums_of_part for each part of a sweep
  ContactSolution mean;         ///< of the last values of P0; without velocities
  std::unique_ptr<ThreadTeam> team;
  TeamChoice choice;           ///< between the team and its first member alone
  std::exception_ptr failure;  ///< what ended the work of a member, for the caller of the team
};

struct AcceleratedOutcome {
  int iterations = 0;  ///< over all contacts
  Residual residual;
};

/// The team that would solve this problem at present; null where one thread does.
ThreadTeam* team_at_hand(const ContactProblem& problem, int threads, AcceleratedWorkspace& workspace);

/// Solves until the natural-map residual is at most `tolerance` or `max_iterations` are spent.
/// Contacts must be sorted by their first body. `solution` as in solve(). `threads` >= 1.
AcceleratedOutcome solve_accelerated(const ContactProblem& problem, double tolerance, int max_iterations,
                                     int threads, AcceleratedWorkspace& workspace, ContactSolution& solution);

}  // namespace talus::solver
