/// Mean of iterates, which ends solves that are in a limit cycle.

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "solver/accelerated.h"
#include "support/scenes.h"
#include "unit/solver/small_problems.h"

namespace talus::solver {
namespace {

TEST(MeanOfIterates, is_that_of_all_values_since_the_first) {
  const ContactProblem problem = test::random_problem(3, 20, 3);
  Linearisation at;
  ContactSolution mean;
  at.pn = at.pt = mean.pn = mean.pt = {0.0, 0.0, 0.0};
  const auto take = [&](int count, double normal, double tangential) {
    at.pn = {normal, 0.0, 2.0 * normal};
    at.pt = {0.0, tangential, -tangential};
    average_impulses(problem, 0, 1, at, count, mean);
  };
  take(1, 100.0, 100.0);
  take(1, 1.0, 4.0);  // equal to the first: earlier iterates are discarded
  take(2, 2.0, -4.0);
  take(3, 6.0, 3.0);
  const std::vector<double> normal = {3.0, 0.0, 6.0}, tangential = {0.0, 1.0, -1.0};
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(mean.pn[c], normal[c], 1e-14);
    EXPECT_NEAR(mean.pt[c], tangential[c], 1e-14);
  }
}

/// Returns random contacts, sorted by their first body as the solver requires.
ContactProblem sorted_problem(std::uint64_t seed, Index bodies, Index contacts) {
  const ContactProblem drawn = test::random_problem(seed, bodies, contacts);
  std::vector<std::size_t> order(drawn.a.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t c) { return drawn.a[c]; });
  ContactProblem problem = drawn;
  for (std::size_t c = 0; c < order.size(); ++c) {
    for (auto field : {&ContactProblem::a, &ContactProblem::b})
      (problem.*field)[c] = (drawn.*field)[order[c]];
    for (auto field : {&ContactProblem::nx, &ContactProblem::ny, &ContactProblem::cn, &ContactProblem::ct,
                       &ContactProblem::mu})
      (problem.*field)[c] = (drawn.*field)[order[c]];
  }
  return problem;
}

/// Returns impulses and iterations of a problem that does not converge before means are taken.
ContactSolution solved(const ContactProblem& problem, int threads, AcceleratedOutcome& outcome) {
  AcceleratedWorkspace workspace;
  ContactSolution solution = test::no_guess(problem);
  outcome = solve_accelerated(problem, 1e-300, 580, threads, workspace, solution);
  return solution;
}

// 580 iterations contain one mean.
TEST(MeanOfIterates, has_the_same_bits_on_any_number_of_threads) {
  const ContactProblem problem = sorted_problem(1, 1500, 2000);
  AcceleratedOutcome one, three;
  const ContactSolution alone = solved(problem, 1, one), in_team = solved(problem, 3, three);
  EXPECT_EQ(one.iterations, 580);
  EXPECT_EQ(three.iterations, 580);
  EXPECT_EQ(one.residual.eta, three.residual.eta);
  EXPECT_EQ(alone.pn, in_team.pn);
  EXPECT_EQ(alone.pt, in_team.pt);
}

/// Returns a step of a falling bed whose iterates form a limit cycle.
test::FrozenStep step_in_circles() {
  const dynamics::StepSettings settings = test::bed_step(1e-6);
  return test::next_problem(test::fallen_bed(test::bed_plan(false, 150, 16, 21), settings, 128), settings);
}

// Without the mean, the residual of the solve stays at 6e-5 for any number of iterations.
TEST(MeanOfIterates, ends_a_step_that_goes_round_in_circles) {
  test::FrozenStep frozen = step_in_circles();
  AcceleratedWorkspace workspace;
  const AcceleratedOutcome outcome =
      solve_accelerated(frozen.problem, 1e-5, 2000, 1, workspace, frozen.guess);
  EXPECT_LE(outcome.residual.eta, 1e-5);
  EXPECT_GT(outcome.iterations, 512) << "before means are taken";
}

// One case in which the mean is better, and one in which it is not and the last iterate stays.
TEST(MeanOfIterates, leaves_the_impulses_whose_residual_is_told) {
  const test::FrozenStep frozen = step_in_circles();
  for (int most = 512 + 16; most <= 1024; most += 16) {
    AcceleratedWorkspace workspace;
    ContactSolution solution = frozen.guess;
    const AcceleratedOutcome outcome =
        solve_accelerated(frozen.problem, 1e-300, most, 1, workspace, solution);
    velocities_from_impulses(frozen.problem, solution);
    const double eta = natural_map_residual(frozen.problem, solution).eta;
    EXPECT_NEAR(outcome.residual.eta, eta, 1e-5 * eta + 1e-14) << most;
  }
}

}  // namespace
}  // namespace talus::solver
