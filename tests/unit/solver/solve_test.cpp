#include "solver/solve.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "solver/gauss_seidel.h"
#include "support/scenes.h"
#include "unit/solver/small_problems.h"

namespace talus::solver {
namespace {

class Solve : public testing::TestWithParam<SolverKind> {
 protected:
  SolverReport solve_to(const ContactProblem& problem, ContactSolution& solution, double tolerance,
                        int max_iterations = 5000) {
    SolverSettings settings;
    settings.kind = GetParam();
    settings.tolerance = tolerance;
    settings.max_iterations = max_iterations;
    SolverWorkspace workspace;
    return solve(problem, settings, workspace, solution);
  }
};

INSTANTIATE_TEST_SUITE_P(Solvers, Solve, testing::ValuesIn(test::both_solvers),
                         [](const auto& parameter) { return test::name_of(parameter.param); });

TEST_P(Solve, an_empty_problem) {
  ContactSolution solution;
  const SolverReport report = solve_to({}, solution, 1e-10);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.residual.eta, 0.0);
  EXPECT_TRUE(solution.pn.empty());
  EXPECT_TRUE(solution.vx.empty());
}

TEST_P(Solve, bodies_without_contacts_keep_their_free_velocity) {
  ContactProblem problem;
  test::add_body(problem, 2.0, 0.1, 1.0, -3.0, 0.5);
  ContactSolution solution;
  EXPECT_TRUE(solve_to(problem, solution, 1e-10).converged);
  EXPECT_EQ(solution.vx, problem.vx);
  EXPECT_EQ(solution.vy, problem.vy);
  EXPECT_EQ(solution.omega, problem.omega);
}

// A disk of 2 kg falls at 1 m/s on a fixed body: P_n = 2, and P_t = 0.4 stops its slip of 0.6 m/s (w_t =
// m/3).
TEST_P(Solve, one_contact_that_sticks) {
  const ContactProblem problem = test::one_contact(0.6, 0.5);
  ContactSolution solution = test::no_guess(problem);
  const SolverReport report = solve_to(problem, solution, 1e-12);
  EXPECT_TRUE(report.converged);
  EXPECT_NEAR(solution.pn[0], 2.0, 1e-11);
  EXPECT_NEAR(solution.pt[0], 0.4, 1e-11);
  EXPECT_NEAR(solution.vx[0], 0.4, 1e-11);  // rolls on with 2/3 of its velocity
  EXPECT_NEAR(solution.vy[0], 0.0, 1e-11);
  EXPECT_NEAR(solution.omega[0], -4.0, 1e-10);  // clockwise: v + r omega = 0
}

// With mu = 0.1 friction is limited to P_t = 0.2: v_x = 0.6 - 0.1, omega = -0.2 r / I.
TEST_P(Solve, one_contact_that_slides) {
  const ContactProblem problem = test::one_contact(0.6, 0.1);
  ContactSolution solution = test::no_guess(problem);
  EXPECT_TRUE(solve_to(problem, solution, 1e-12).converged);
  EXPECT_NEAR(solution.pn[0], 2.0, 1e-11);
  EXPECT_NEAR(solution.pt[0], 0.2, 1e-11);
  EXPECT_NEAR(solution.vx[0], 0.5, 1e-11);
  EXPECT_NEAR(solution.omega[0], -2.0, 1e-10);
}

TEST_P(Solve, one_contact_that_opens_forgets_its_guess) {
  ContactProblem problem = test::one_contact(0.6, 0.5);
  problem.vy[0] = 1.0;
  ContactSolution solution = test::no_guess(problem);
  solution.pn = {3.0};
  solution.pt = {-1.0};
  EXPECT_TRUE(solve_to(problem, solution, 1e-12).converged);
  EXPECT_EQ(solution.pn[0], 0.0);
  EXPECT_EQ(solution.pt[0], 0.0);
  EXPECT_EQ(solution.vy[0], 1.0);
}

TEST_P(Solve, a_fixed_body_may_be_on_either_side) {
  ContactProblem problem = test::one_contact(0.6, 0.5);
  std::swap(problem.a, problem.b);
  problem.ny[0] = 1.0;
  ContactSolution solution = test::no_guess(problem);
  EXPECT_TRUE(solve_to(problem, solution, 1e-12).converged);
  EXPECT_NEAR(solution.vx[0], 0.4, 1e-11);
  EXPECT_NEAR(solution.vy[0], 0.0, 1e-11);
  EXPECT_NEAR(solution.omega[0], -4.0, 1e-10);
  EXPECT_EQ(solution.vy[1], 0.0);
}

// 40 disks, each on a separate fixed body: 40 independent problems of one contact.
TEST_P(Solve, contacts_that_share_only_fixed_bodies_do_not_feel_each_other) {
  ContactProblem problem;
  for (Index i = 0; i < 40; ++i) test::add_body(problem, 1.0 + i, 0.1, 0.01 * i, -1.0, 0.0);
  test::add_body(problem, 0.0, 0.1, 0.0, 0.0, 0.0);
  for (Index i = 0; i < 40; ++i) test::add_contact(problem, i, 40, 0.0, -1.0, 0.5);
  ContactSolution solution = test::no_guess(problem);
  EXPECT_TRUE(solve_to(problem, solution, 1e-12).converged);
  for (Index i = 0; i < 40; ++i) EXPECT_NEAR(solution.pn[i], 1.0 + i, 1e-9);
}

// A disk at rest is hit and becomes so fast that it would cross the gap to a fixed disk, which closes only at
// 3 m/s. That contact is not among those swept at first.
TEST_P(Solve, a_contact_that_closes_late_is_found) {
  ContactProblem problem;
  test::add_body(problem, 1.0, 0.1, 10.0, 0.0, 0.0);
  test::add_body(problem, 1.0, 0.1, 0.0, 0.0, 0.0);
  test::add_body(problem, 0.0, 0.1, 0.0, 0.0, 0.0);
  test::add_contact(problem, 0, 1, 1.0, 0.0, 0.5);
  test::add_contact(problem, 1, 2, 1.0, 0.0, 0.5, 3.0);
  ContactSolution solution = test::no_guess(problem);
  EXPECT_TRUE(solve_to(problem, solution, 1e-12).converged);
  EXPECT_NEAR(solution.vx[0], 3.0, 1e-10);
  EXPECT_NEAR(solution.vx[1], 3.0, 1e-10);
  EXPECT_NEAR(solution.pn[0], 7.0, 1e-10);
  EXPECT_NEAR(solution.pn[1], 4.0, 1e-10);
}

// n disks in a row are stopped by a fixed one: contact k carries the momentum of all disks behind it.
TEST_P(Solve, a_row_of_disks_adds_up_its_momentum) {
  ContactProblem problem;
  for (Index i = 0; i < 8; ++i) test::add_body(problem, 1.0, 0.1, 1.0, 0.0, 0.0);
  test::add_body(problem, 0.0, 0.1, 0.0, 0.0, 0.0);
  for (Index i = 0; i < 8; ++i) test::add_contact(problem, i, i + 1, 1.0, 0.0, 0.5);
  ContactSolution solution = test::no_guess(problem);
  EXPECT_TRUE(solve_to(problem, solution, 1e-12).converged);
  for (Index i = 0; i < 8; ++i) EXPECT_NEAR(solution.pn[i], i + 1.0, 1e-9);
}

TEST_P(Solve, says_so_when_it_did_not_converge) {
  const dynamics::StepSettings settings = test::bed_step();
  const World world = test::fallen_bed(test::bed_plan(true, 30, 6, 1), settings, 100);
  const auto [contacts, problem, guess] = test::next_problem(world, settings);
  ContactSolution solution = test::no_guess(problem);
  const SolverReport report = solve_to(problem, solution, 1e-10, 1);
  EXPECT_FALSE(report.converged);
  EXPECT_LE(report.iterations, 1);
  EXPECT_GT(report.residual.eta, 1e-3);
  EXPECT_DOUBLE_EQ(report.residual.eta,
                   natural_map_residual(problem, solution).eta);  // the sums have different orders
}

TEST_P(Solve, its_residual_and_velocities_are_those_of_its_impulses) {
  const dynamics::StepSettings settings = test::bed_step();
  const World world = test::fallen_bed(test::bed_plan(true, 30, 6, 2), settings, 100);
  const auto [contacts, problem, guess] = test::next_problem(world, settings);
  ContactSolution solution = guess;
  const SolverReport report = solve_to(problem, solution, 1e-8);
  ContactSolution again = solution;
  velocities_from_impulses(problem, again);
  EXPECT_TRUE(report.converged);
  EXPECT_GT(report.iterations, 0);
  EXPECT_NEAR(report.residual.eta, natural_map_residual(problem, again).eta, 1e-6 * report.residual.eta);
  EXPECT_NEAR(report.residual.largest, natural_map_residual(problem, again).largest,
              1e-6 * report.residual.largest);
  const double largest_kick = *std::max_element(solution.pn.begin(), solution.pn.end()) *
                              *std::max_element(problem.inverse_mass.begin(), problem.inverse_mass.end());
  for (Index i = 0; i < problem.body_count(); ++i) {
    EXPECT_NEAR(again.vx[i], solution.vx[i], 1e-14 * largest_kick);
    EXPECT_NEAR(again.vy[i], solution.vy[i], 1e-14 * largest_kick);
    EXPECT_NEAR(again.omega[i] * problem.lever[i], solution.omega[i] * problem.lever[i],
                1e-14 * largest_kick);
  }
  for (Index c = 0; c < problem.contact_count(); ++c) {
    EXPECT_GE(solution.pn[c], 0.0);
    EXPECT_LE(std::abs(solution.pt[c]), problem.mu[c] * solution.pn[c]);
  }
}

TEST_P(Solve, starts_from_the_guess) {
  const dynamics::StepSettings settings = test::bed_step();
  const World world = test::fallen_bed(test::bed_plan(true, 30, 6, 2), settings, 100);
  const auto [contacts, problem, guess] = test::next_problem(world, settings);
  ContactSolution cold = test::no_guess(problem);
  const SolverReport from_zero = solve_to(problem, cold, 1e-8);
  ASSERT_TRUE(from_zero.converged);
  ContactSolution warm = cold;
  EXPECT_GT(from_zero.iterations, 10);
  EXPECT_LE(solve_to(problem, warm, 1e-8).iterations, 1);
}

// Bodies of 2 and 3 kg fall at 1 m/s, one above the other. In the first sweep their common contact needs no
// impulse, and then the floor stops the momentum of body 0, 2; later the floor must carry all of 5.
TEST(GaussSeidel, a_sweep_solves_contact_by_contact_in_their_order) {
  ContactProblem problem;
  test::add_body(problem, 2.0, 0.1, 0.0, -1.0, 0.0);
  test::add_body(problem, 3.0, 0.1, 0.0, -1.0, 0.0);
  test::add_body(problem, 0.0, 0.1, 0.0, 0.0, 0.0);
  test::add_contact(problem, 0, 1, 0.0, 1.0, 0.5);
  test::add_contact(problem, 0, 2, 0.0, -1.0, 0.5);
  ContactSolution solution = test::no_guess(problem);
  velocities_from_impulses(problem, solution);
  gauss_seidel_sweep(problem, solution);
  EXPECT_DOUBLE_EQ(solution.pn[0], 0.0);
  EXPECT_DOUBLE_EQ(solution.pn[1], 2.0);
  // Now body 0 is at rest and body 1 falls on it at 1 m/s: W_nn = 1/2 + 1/3, so the impulse between them is
  // 1.2.
  gauss_seidel_sweep(problem, solution);
  EXPECT_DOUBLE_EQ(solution.pn[0], 1.2);
  EXPECT_DOUBLE_EQ(solution.pn[1], 3.2);
}

TEST(GaussSeidel, a_sweep_keeps_velocities_and_impulses_together) {
  const ContactProblem problem = test::random_problem(7, 12, 25);
  ContactSolution solution = test::no_guess(problem);
  velocities_from_impulses(problem, solution);
  for (int k = 0; k < 20; ++k) gauss_seidel_sweep(problem, solution);
  ContactSolution again = solution;
  velocities_from_impulses(problem, again);
  for (Index i = 0; i < problem.body_count(); ++i) {
    EXPECT_NEAR(solution.vx[i], again.vx[i], 1e-13);
    EXPECT_NEAR(solution.vy[i], again.vy[i], 1e-13);
    EXPECT_NEAR(solution.omega[i], again.omega[i], 1e-13);
  }
}

}  // namespace
}  // namespace talus::solver
