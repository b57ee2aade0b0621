#pragma once
/// The accelerated solver: projected gradient with Nesterov's momentum. Each pass is a Jacobi step, so it
/// vectorises and runs on any number of threads with the same bits.

#include <memory>
#include <vector>

#include "solver/gradient_kernels.h"
#include "solver/problem.h"
#include "solver/thread_team.h"

namespace talus {

/// Arrays and threads kept between solves; no state that a result depends on. Contacts are padded to whole
/// lanes.
struct AcceleratedWorkspace {
  std::vector<Quad> free, mobility, now, ahead;    ///< bodies: see GradientArrays
  std::vector<double> nx, ny, cn, ct, wn, wt, mu;  ///< contacts
  std::vector<double> pn, pt, pn_before, pt_before;
  std::vector<Quad> force;
  std::vector<Index> a, b;
  std::vector<Index> first_a, first_b, b_contact;  ///< contacts of each body
  std::vector<PassSums> sums;                      ///< one for each block of contacts
  std::unique_ptr<ThreadTeam> team;
};

/// Solves until the natural-map residual is at most `tolerance` or `max_iterations` passes are spent; returns
/// the passes. Contacts must be sorted by their first body. `solution` as in solve(). `threads` >= 1.
int solve_accelerated(const ContactProblem& problem, double tolerance, int max_iterations, int threads,
                      AcceleratedWorkspace& workspace, ContactSolution& solution);

}  // namespace talus
