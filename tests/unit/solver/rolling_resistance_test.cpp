/// Rolling resistance in the contact problem (T38) to (T40), with both solvers.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solver/solve.h"
#include "support/scenes.h"
#include "unit/solver/small_problems.h"

namespace talus::solver {
namespace {

/// Returns a disk of 2 kg and radius 0.1 that falls at 1 m/s on a fixed one of radius 0.2 and slides along it
/// at 0.6 m/s: P_n = 2, l = 0.3. Friction is strong enough to stop the slip.
ContactProblem disk_that_rolls(double mu_r) {
  ContactProblem problem = test::one_contact(0.6, 1.0);
  problem.rolling_friction = {mu_r};
  return problem;
}

Residual residual_at(const ContactProblem& problem, double pn, double pt, double pr) {
  ContactSolution solution;
  solution.pn = {pn};
  solution.pt = {pt};
  solution.pr = {pr};
  velocities_from_impulses(problem, solution);
  return natural_map_residual(problem, solution);
}

class RollingResistance : public testing::TestWithParam<SolverKind> {
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

INSTANTIATE_TEST_SUITE_P(Solvers, RollingResistance, testing::ValuesIn(test::both_solvers),
                         [](const auto& parameter) { return test::name_of(parameter.param); });

// The disk rolls clockwise, so that U_r > 0 and P_r = -mu_r P_n. With v = -r omega, m (0.6 - v) = P_t and I
// omega = -r P_t - l P_r: 3/2 v = 0.6 - mu_r (l / r) P_n / m.
TEST_P(RollingResistance, slows_a_disk_that_rolls) {
  const ContactProblem problem = disk_that_rolls(0.1);
  ContactSolution solution = test::no_guess(problem);
  EXPECT_TRUE(solve_to(problem, solution, 1e-12).converged);
  EXPECT_NEAR(solution.pn[0], 2.0, 1e-11);
  EXPECT_NEAR(solution.pt[0], 0.8, 1e-11);
  EXPECT_NEAR(solution.pr[0], -0.2, 1e-11);
  EXPECT_NEAR(solution.vx[0], 0.2, 1e-11);
  EXPECT_NEAR(solution.omega[0], -2.0, 1e-10);
}

TEST_P(RollingResistance, stops_a_disk_where_it_is_large_enough) {
  const ContactProblem problem = disk_that_rolls(0.3);
  ContactSolution solution = test::no_guess(problem);
  EXPECT_TRUE(solve_to(problem, solution, 1e-12).converged);
  EXPECT_NEAR(solution.pt[0], 1.2, 1e-11);
  EXPECT_NEAR(solution.pr[0], -0.4, 1e-11);  // l P_r + r P_t = 0
  EXPECT_NEAR(solution.vx[0], 0.0, 1e-11);
  EXPECT_NEAR(solution.omega[0], 0.0, 1e-10);
}

TEST_P(RollingResistance, a_fixed_body_may_be_on_either_side) {
  ContactProblem problem = disk_that_rolls(0.1);
  std::swap(problem.a, problem.b);
  problem.ny[0] = 1.0;
  ContactSolution solution = test::no_guess(problem);
  EXPECT_TRUE(solve_to(problem, solution, 1e-12).converged);
  EXPECT_NEAR(solution.pr[0], 0.2, 1e-11);
  EXPECT_NEAR(solution.vx[0], 0.2, 1e-11);
  EXPECT_NEAR(solution.omega[0], -2.0, 1e-10);
}

TEST_P(RollingResistance, forgets_its_guess_where_the_contact_opens) {
  ContactProblem problem = disk_that_rolls(0.3);
  problem.vy[0] = 1.0;
  ContactSolution solution = test::no_guess(problem);
  solution.pn = {3.0};
  solution.pr = {0.5};
  EXPECT_TRUE(solve_to(problem, solution, 1e-12).converged);
  EXPECT_EQ(solution.pr[0], 0.0);
  EXPECT_EQ(solution.omega[0], 0.0);
}

// Velocities and residual of a bed are those of its impulses, which obey the bounds of the law.
TEST_P(RollingResistance, of_a_bed_obeys_its_law) {
  dynamics::StepSettings settings = test::bed_step();
  settings.law.rolling_friction = 0.1;
  const World world = test::fallen_bed(test::bed_plan(true, 30, 6, 2), settings, 100);
  const auto [contacts, problem, guess] = test::next_problem(world, settings);
  ContactSolution solution = guess;
  const SolverReport report = solve_to(problem, solution, 1e-9, 50000);
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

TEST(RollingResidual, is_zero_at_a_solution) {
  EXPECT_NEAR(residual_at(disk_that_rolls(0.1), 2.0, 0.8, -0.2).eta, 0.0, 1e-15);
  EXPECT_NEAR(residual_at(disk_that_rolls(0.3), 2.0, 1.2, -0.4).eta, 0.0, 1e-15);
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

class RollingPacking : public testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Seeds, RollingPacking, testing::Range(1, 13));

dynamics::StepSettings rolling_settings(int seed) {
  dynamics::StepSettings settings = test::bed_step(1e-8);
  settings.law.rolling_friction = seed % 2 == 0 ? 0.05 : 0.3;
  return settings;
}

test::FrozenStep packing(int seed) {
  const dynamics::StepSettings settings = rolling_settings(seed);
  const dynamics::BedPlan plan = test::bed_plan(seed % 3 == 0, 24, 6, static_cast<std::uint64_t>(seed));
  World world = test::fallen_bed(plan, settings, 75 + 25 * (seed % 5));
  world.tilt = 0.04 * (seed % 6);
  test::FrozenStep frozen = test::next_problem(world, settings);
  for (double& cn : frozen.problem.cn)  // see packings_test.cpp
    if (std::fabs(cn) < 2e-8 / settings.h) cn = 0.0;
  return frozen;
}

TEST_P(RollingPacking, solvers_agree_on_velocities) {
  const test::FrozenStep frozen = packing(GetParam());
  ASSERT_GT(frozen.problem.contact_count(), 10);
  SolverSettings settings;
  settings.tolerance = 1e-10;
  settings.max_iterations = 50000;
  SolverWorkspace workspace;
  ContactSolution solutions[2] = {frozen.guess, frozen.guess};
  int iterations[2] = {};
  for (int k = 0; k < 2; ++k) {
    settings.kind = test::both_solvers[k];
    const SolverReport report = solve(frozen.problem, settings, workspace, solutions[k]);
    EXPECT_TRUE(report.converged) << test::name_of(settings.kind) << " " << report.residual.eta;
    iterations[k] = report.iterations;
  }
  double difference = 0.0;
  for (std::size_t i = 0; i < solutions[0].vx.size(); ++i)
    difference =
        std::max({difference, std::fabs(solutions[0].vx[i] - solutions[1].vx[i]),
                  std::fabs(solutions[0].vy[i] - solutions[1].vy[i]),
                  frozen.problem.lever[i] * std::fabs(solutions[0].omega[i] - solutions[1].omega[i])});
  EXPECT_LT(difference, 1e-6 * 9.81 * test::time_step);
  RecordProperty("sweeps", std::to_string(iterations[0]) + "/" + std::to_string(iterations[1]));
}

// Data that a workspace keeps for contacts with free or weaker-resisted rolling are not used for contacts
// that resist it.
TEST_P(RollingPacking, the_same_problem_has_the_same_bits) {
  const test::FrozenStep frozen = packing(GetParam());
  SolverSettings settings;
  settings.tolerance = 1e-8;
  settings.max_iterations = 300;
  ContactProblem less = frozen.problem, free = frozen.problem;
  for (double& mu_r : less.rolling_friction) mu_r *= 0.5;
  free.rolling_friction.clear();
  for (const ContactProblem* other : {&less, &free}) {
    SolverWorkspace fresh, used;
    ContactSolution first = frozen.guess, second = frozen.guess, before = frozen.guess;
    if (!other->resists_rolling()) before.pr.clear();
    ContactSolution other_first = before, other_second = before;
    solve(frozen.problem, settings, fresh, first);
    solve(*other, settings, used, other_first);
    solve(frozen.problem, settings, used, second);
    EXPECT_EQ(first.pn, second.pn);
    EXPECT_EQ(first.pr, second.pr);
    EXPECT_EQ(first.omega, second.omega);
    solve(*other, settings, fresh, other_second);
    EXPECT_EQ(other_first.omega, other_second.omega);
  }
}

}  // namespace
}  // namespace talus::solver
