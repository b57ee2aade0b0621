/// Rolling resistance in the contact problem (T38) to (T40), with both solvers.

#include "solver/solve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/scenes.h"
#include "unit/solver/small_problems.h"

namespace talus::solver {
namespace {

class Solve : public testing::TestWithParam<SolverKind> {
 protected:
  /// Returns the solution of a problem, which the solver must reach.
  static ContactSolution solved(const ContactProblem& problem) {
    return solved(problem, test::no_guess(problem));
  }
  static ContactSolution solved(const ContactProblem& problem, ContactSolution solution) {
    EXPECT_TRUE(test::solve_to(GetParam(), problem, solution, 1e-12).converged);
    return solution;
  }
  /// Makes the problem of the first step after a bed has fallen.
  void let_fall(std::uint64_t seed, double rolling_friction = 0.0) {
    dynamics::StepSettings settings = test::bed_step();
    settings.law.rolling_friction = rolling_friction;
    const World world = test::fallen_bed(test::bed_plan(true, 30, 6, seed), settings, 100);
    frozen_ = test::next_problem(world, settings);
  }

  test::FrozenStep frozen_;
};

INSTANTIATE_TEST_SUITE_P(Solvers, Solve, testing::ValuesIn(test::both_solvers),
                         [](const auto& parameter) { return test::name_of(parameter.param); });

// A disk of 2 kg falls at 1 m/s on a fixed body: P_n = 2, and P_t = 0.4 stops its slip of 0.6 m/s (w_t =
// m/3).
TEST_P(Solve, one_contact_that_sticks_whichever_body_is_the_fixed_one) {
  for (const bool swapped : {false, true}) {
    const ContactSolution solution = solved(test::one_contact(0.6, 0.5, swapped));
    EXPECT_NEAR(solution.pn[0], 2.0, 1e-11);
    EXPECT_NEAR(solution.pt[0], 0.4, 1e-11);
    EXPECT_NEAR(solution.vx[0], 0.4, 1e-11);  // rolls on with 2/3 of its velocity
    EXPECT_NEAR(solution.vy[0], 0.0, 1e-11);
    EXPECT_NEAR(solution.omega[0], -4.0, 1e-10);  // clockwise: v + r omega = 0
    EXPECT_EQ(solution.vy[1], 0.0);
  }
}

// With mu = 0.1 friction is limited to P_t = 0.2: v_x = 0.6 - 0.1, omega = -0.2 r / I.
TEST_P(Solve, one_contact_that_slides) {
  const ContactSolution solution = solved(test::one_contact(0.6, 0.1));
  EXPECT_NEAR(solution.pn[0], 2.0, 1e-11);
  EXPECT_NEAR(solution.pt[0], 0.2, 1e-11);
  EXPECT_NEAR(solution.vx[0], 0.5, 1e-11);
  EXPECT_NEAR(solution.omega[0], -2.0, 1e-10);
}

TEST_P(Solve, one_contact_that_opens_forgets_its_guess) {
  for (const std::vector<double>& rolling_friction : {std::vector<double>(), {0.3}}) {
    ContactProblem problem = test::one_contact(0.6, 0.5);
    problem.vy[0] = 1.0;
    problem.rolling_friction = rolling_friction;
    ContactSolution guess = test::no_guess(problem);
    guess.pn = {3.0};
    guess.pt = {-1.0};
    if (problem.resists_rolling()) guess.pr = {0.5};
    const ContactSolution solution = solved(problem, guess);
    EXPECT_EQ(solution.pn[0], 0.0);
    EXPECT_EQ(solution.pt[0], 0.0);
    EXPECT_EQ(solution.pr, std::vector<double>(rolling_friction.size(), 0.0));
    EXPECT_EQ(solution.vy[0], 1.0);
    EXPECT_EQ(solution.omega[0], 0.0);
  }
}

// 40 disks, each on a separate fixed body: 40 independent problems of one contact.
TEST_P(Solve, contacts_that_share_only_fixed_bodies_do_not_feel_each_other) {
  ContactProblem problem;
  for (Index i = 0; i < 40; ++i) test::add_body(problem, 1.0 + i, 0.1, 0.01 * i, -1.0, 0.0);
  test::add_body(problem, 0.0, 0.1, 0.0, 0.0, 0.0);
  for (Index i = 0; i < 40; ++i) test::add_contact(problem, i, 40, 0.0, -1.0, 0.5);
  const ContactSolution solution = solved(problem);
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
  const ContactSolution solution = solved(problem);
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
  const ContactSolution solution = solved(problem);
  for (Index i = 0; i < 8; ++i) EXPECT_NEAR(solution.pn[i], i + 1.0, 1e-9);
}

TEST_P(Solve, says_so_when_it_did_not_converge) {
  let_fall(1);
  const auto& [contacts, problem, guess] = frozen_;
  ContactSolution solution = test::no_guess(problem);
  const SolverReport report = test::solve_to(GetParam(), problem, solution, 1e-10, 1);
  EXPECT_FALSE(report.converged);
  EXPECT_LE(report.iterations, 1);
  EXPECT_GT(report.residual.eta, 1e-3);
  EXPECT_DOUBLE_EQ(report.residual.eta,
                   natural_map_residual(problem, solution).eta);  // the sums have different orders
}

TEST_P(Solve, its_residual_and_velocities_are_those_of_its_impulses) {
  let_fall(2);
  const auto& [contacts, problem, guess] = frozen_;
  ContactSolution solution = guess;
  const SolverReport report = test::solve_to(GetParam(), problem, solution, 1e-8);
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
  let_fall(2);
  const auto& [contacts, problem, guess] = frozen_;
  ContactSolution cold = test::no_guess(problem);
  const SolverReport from_zero = test::solve_to(GetParam(), problem, cold, 1e-8);
  ASSERT_TRUE(from_zero.converged);
  ContactSolution warm = cold;
  EXPECT_GT(from_zero.iterations, 10);
  EXPECT_LE(test::solve_to(GetParam(), problem, warm, 1e-8).iterations, 1);
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

/// Returns a disk of 2 kg and radius 0.1 that falls at 1 m/s on a fixed one of radius 0.2 and slides along it
/// at 0.6 m/s: P_n = 2, l = 0.3. Friction is strong enough to stop the slip.
ContactProblem disk_that_rolls(double mu_r, bool swapped = false) {
  ContactProblem problem = test::one_contact(0.6, 1.0, swapped);
  problem.rolling_friction = {mu_r};
  return problem;
}

class RollingResistance : public Solve {};

INSTANTIATE_TEST_SUITE_P(Solvers, RollingResistance, testing::ValuesIn(test::both_solvers),
                         [](const auto& parameter) { return test::name_of(parameter.param); });

// The disk rolls clockwise, so that U_r > 0 and P_r = -mu_r P_n. With v = -r omega, m (0.6 - v) = P_t and I
// omega = -r P_t - l P_r: 3/2 v = 0.6 - mu_r (l / r) P_n / m.
TEST_P(RollingResistance, slows_a_disk_that_rolls_whichever_body_is_the_fixed_one) {
  for (const bool swapped : {false, true}) {
    const ContactSolution solution = solved(disk_that_rolls(0.1, swapped));
    EXPECT_NEAR(solution.pn[0], 2.0, 1e-11);
    EXPECT_NEAR(solution.pt[0], 0.8, 1e-11);
    EXPECT_NEAR(solution.pr[0], swapped ? 0.2 : -0.2, 1e-11);
    EXPECT_NEAR(solution.vx[0], 0.2, 1e-11);
    EXPECT_NEAR(solution.omega[0], -2.0, 1e-10);
  }
}

TEST_P(RollingResistance, stops_a_disk_where_it_is_large_enough) {
  const ContactSolution solution = solved(disk_that_rolls(0.3));
  EXPECT_NEAR(solution.pt[0], 1.2, 1e-11);
  EXPECT_NEAR(solution.pr[0], -0.4, 1e-11);  // l P_r + r P_t = 0
  EXPECT_NEAR(solution.vx[0], 0.0, 1e-11);
  EXPECT_NEAR(solution.omega[0], 0.0, 1e-10);
}

// Velocities and residual of a bed are those of its impulses, which obey the bounds of the law.
TEST_P(RollingResistance, of_a_bed_obeys_its_law) {
  let_fall(2, 0.1);
  const auto& [contacts, problem, guess] = frozen_;
  ContactSolution solution = guess;
  const SolverReport report = test::solve_to(GetParam(), problem, solution, 1e-9, 50000);
  EXPECT_TRUE(report.converged) << report.residual.eta;
  ContactSolution again = solution;
  velocities_from_impulses(problem, again);
  EXPECT_NEAR(report.residual.eta, natural_map_residual(problem, again).eta, 1e-3 * report.residual.eta);
  double largest = 0.0, unit = 0.0, rim = 0.0;
  Index rolling = 0, holding = 0;
  for (Index i = 0; i < problem.body_count(); ++i) {
    largest = std::max(largest, problem.lever[i] * std::fabs(again.omega[i] - solution.omega[i]));
    rim = std::max(rim, problem.lever[i] * std::fabs(solution.omega[i]));
  }
  EXPECT_LT(largest, 1e-11 * rim);
  for (const double pn : solution.pn) unit = std::max(unit, pn);
  for (Index c = 0; c < problem.contact_count(); ++c) {
    const double bound = 0.1 * solution.pn[c], pr = solution.pr[c];
    EXPECT_LE(std::fabs(pr), bound);
    const double ur = rolling_velocity(problem, solution, c);
    if (std::fabs(pr) < bound - 1e-6 * unit) {
      EXPECT_NEAR(ur, 0.0, 1e-6 * rim) << c;
      ++holding;
    } else if (bound > 1e-6 * unit && std::fabs(ur) > 1e-6 * rim) {
      EXPECT_LT(pr * ur, 0.0) << c;
      ++rolling;
    }
  }
  EXPECT_GT(rolling, 3);
  EXPECT_GT(holding, 3);
}

// U_r = l (-omega): starting from P_r = -0.1 and the resulting velocities, solving moves it to its bound.
TEST(RollingResidual, counts_what_is_missing_of_a_rolling_impulse) {
  const ContactProblem problem = disk_that_rolls(0.1);
  ContactSolution solution;
  solution.pn = {2.0};
  solution.pt = {0.8};
  solution.pr = {-0.1};
  velocities_from_impulses(problem, solution);
  // omega = (-0.08 + 0.03) / 0.01 = -5: U_t = -0.2 + 0.5, and w_t = 2 / 3 moves P_t to 1.
  const double dt = 0.2, dr = -0.1;
  EXPECT_NEAR(natural_map_residual(problem, solution).eta,
              std::hypot(dt, dr) / std::sqrt(2.0 * 2.0 + 0.8 * 0.8 + 0.1 * 0.1), 1e-14);
}

}  // namespace
}  // namespace talus::solver
