#include "solver/residual.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/solver/small_problems.h"

namespace talus::solver {
namespace {

Residual residual_at(const ContactProblem& problem, const std::vector<double>& pn,
                     const std::vector<double>& pt) {
  ContactSolution solution;
  solution.pn = pn;
  solution.pt = pt;
  velocities_from_impulses(problem, solution);
  return natural_map_residual(problem, solution);
}

// A disk of 2 kg is stopped from 1 m/s: P_n = 2. It slides at 0.6 m/s with w_t = m / 3, so P_t = 0.4 stops
// the slip.
TEST(Residual, is_zero_at_a_solution) {
  const ContactProblem problem = test::one_contact(0.6, 0.5);
  const Residual solved = residual_at(problem, {2.0}, {0.4});
  EXPECT_NEAR(solved.eta, 0.0, 1e-15);
  EXPECT_NEAR(solved.largest, 0.0, 1e-15);
}

// At P = (1.5, 0): P' = (2, 0.4), so eta = |(0.5, 0.4)| / 1.5.
TEST(Residual, is_the_change_of_a_jacobi_step_over_the_impulse) {
  const Residual residual = residual_at(test::one_contact(0.6, 0.5), {1.5}, {0.0});
  EXPECT_NEAR(residual.eta, std::hypot(0.5, 0.4) / 1.5, 1e-15);
  EXPECT_NEAR(residual.largest, residual.eta, 1e-15);
}

// At P = (1.5, 0) with mu = 0.1 friction is limited to mu P'_n = 0.2.
TEST(Residual, knows_the_cone_of_the_next_normal_impulse) {
  const Residual residual = residual_at(test::one_contact(0.6, 0.1), {1.5}, {0.0});
  EXPECT_NEAR(residual.eta, std::hypot(0.5, 0.2) / 1.5, 1e-15);
}

TEST(Residual, of_no_impulse_is_measured_by_the_one_that_is_missing) {
  EXPECT_DOUBLE_EQ(residual_at(test::one_contact(0.6, 0.5), {0.0}, {0.0}).eta, 1.0);
}

TEST(Residual, is_zero_where_nothing_touches) {
  ContactProblem problem = test::one_contact(0.0, 0.5);
  problem.cn[0] = 1.5;  // the gap closes only at 1.5 m/s
  EXPECT_EQ(residual_at(problem, {0.0}, {0.0}).eta, 0.0);
  EXPECT_EQ(natural_map_residual({}, {}).eta, 0.0);
}

// Two separate disks, one solved and one lacking 1 N s: the largest contribution is the latter's, and eta
// sums squares.
TEST(Residual, names_the_largest_share) {
  ContactProblem problem = test::one_contact(0.0, 0.5);
  test::add_body(problem, 2.0, 0.1, 0.0, -1.0, 0.0);
  test::add_body(problem, 2.0, 0.1, 0.0, -1.0, 0.0);
  test::add_contact(problem, 1, 2, 0.0, 1.0, 0.5);
  test::add_contact(problem, 1, 3, 0.0, 1.0, 0.5);
  const Residual residual = residual_at(problem, {2.0, 1.0, 1.5}, {0.0, 0.0, 0.0});
  const double norm = std::sqrt(4.0 + 1.0 + 2.25);
  EXPECT_NEAR(residual.eta, std::sqrt(1.0 + 0.25) / norm, 1e-15);
  EXPECT_NEAR(residual.largest, 1.0 / norm, 1e-15);
}

// The residual does not change with the units of mass, length and time.
TEST(Residual, does_not_depend_on_units) {
  const ContactProblem problem = test::random_problem(2, 12, 25);
  ContactProblem scaled = problem;
  const double mass = 1000.0, length = 0.01, time = 60.0;
  const double velocity = length / time;
  for (auto* field : {&scaled.vx, &scaled.vy, &scaled.cn, &scaled.ct})
    for (double& value : *field) value *= velocity;
  for (double& value : scaled.omega) value /= time;
  for (double& value : scaled.lever) value *= length;
  for (double& value : scaled.inverse_mass) value /= mass;
  for (double& value : scaled.inverse_inertia) value /= mass * length * length;
  std::vector<double> pn(25, 0.25), pt(25, 0.0);
  const Residual residual = residual_at(problem, pn, pt);
  for (double& value : pn) value *= mass * velocity;
  EXPECT_GT(residual.eta, 0.1);
  EXPECT_NEAR(residual_at(scaled, pn, pt).eta, residual.eta, 1e-13);
}

}  // namespace
}  // namespace talus::solver
