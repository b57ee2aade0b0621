/// The mean of iterates, which ends solves that go round in circles.

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "solver/accelerated.h"
#include "unit/solver/small_problems.h"

namespace talus {
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
  take(1, 1.0, 4.0);  // as the first again: what was before is forgotten
  take(2, 2.0, -4.0);
  take(3, 6.0, 3.0);
  const std::vector<double> normal = {3.0, 0.0, 6.0}, tangential = {0.0, 1.0, -1.0};
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(mean.pn[c], normal[c], 1e-14);
    EXPECT_NEAR(mean.pt[c], tangential[c], 1e-14);
  }
}

/// Random contacts, sorted by their first body as the solver wants them.
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

/// Impulses and iterations of a problem that does not end before means are taken.
ContactSolution solved(const ContactProblem& problem, int threads, AcceleratedOutcome& outcome) {
  AcceleratedWorkspace workspace;
  ContactSolution solution = test::no_guess(problem);
  outcome = solve_accelerated(problem, 1e-300, 700, threads, workspace, solution);
  return solution;
}

// 700 iterations are three means.
TEST(MeanOfIterates, has_the_same_bits_on_any_number_of_threads) {
  const ContactProblem problem = sorted_problem(1, 1500, 2000);
  AcceleratedOutcome one, three;
  const ContactSolution alone = solved(problem, 1, one), in_team = solved(problem, 3, three);
  EXPECT_EQ(one.iterations, 700);
  EXPECT_EQ(three.iterations, 700);
  EXPECT_EQ(one.residual.eta, three.residual.eta);
  EXPECT_EQ(alone.pn, in_team.pn);
  EXPECT_EQ(alone.pt, in_team.pt);
}

// The residual that is told is that of the impulses that are returned, whether the mean was taken or not.
TEST(MeanOfIterates, leaves_the_impulses_whose_residual_is_told) {
  const ContactProblem problem = sorted_problem(5, 60, 150);
  for (int most : {512 + 48, 512 + 64, 512 + 80}) {
    AcceleratedWorkspace workspace;
    ContactSolution solution = test::no_guess(problem);
    const AcceleratedOutcome outcome = solve_accelerated(problem, 1e-300, most, 1, workspace, solution);
    velocities_from_impulses(problem, solution);
    const double eta = natural_map_residual(problem, solution).eta;
    EXPECT_NEAR(outcome.residual.eta, eta, 1e-5 * eta + 1e-14) << most;
  }
}

}  // namespace
}  // namespace talus
