/// Both solvers on dozens of small packings, falling and at rest.

#include <gtest/gtest.h>

#include <cmath>

#include "solver/solve.h"
#include "support/scenes.h"
#include "unit/solver/small_problems.h"

namespace talus::solver {
namespace {

/// Returns the packing of a seed: periodic or walled, with and without friction, moving or at rest. Every
/// fifth has restitution unless rolling is resisted, at the moment when its first grains reach the floor.
test::FrozenStep packing(std::uint64_t seed, double rolling_friction = 0.0) {
  dynamics::StepSettings settings = test::bed_step(1e-8, seed % 4 == 0 ? 0.0 : 0.5);
  settings.law.restitution = seed % 5 == 0 && rolling_friction == 0.0 ? 0.5 : 0.0;
  settings.law.rolling_friction = rolling_friction;
  const dynamics::BedPlan plan = test::bed_plan(seed % 2 == 0, 24, 6, seed);
  World world = test::fallen_bed(plan, settings, 75 + 25 * static_cast<int>(seed % 5));
  world.tilt = 0.02 * static_cast<double>(seed % 6);
  test::FrozenStep frozen = test::next_problem(world, settings);
  // Loops of contacts close up to the residuals of earlier steps. Closing gaps and overlaps of that size keep
  // the problem solvable to any tolerance; otherwise a loop that does not close gains or loses force in every
  // sweep.
  for (double& cn : frozen.problem.cn)
    if (std::fabs(cn) < 2e-8 / settings.h) cn = 0.0;
  return frozen;
}

/// Returns the largest difference of velocities between the two solvers, both to 1e-10; `alike` is set to
/// whether the accelerated one recognised the contacts as alike.
double difference_of_solvers(const ContactProblem& problem, const ContactSolution& guess, bool& alike) {
  SolverWorkspace workspace;
  ContactSolution solutions[2] = {guess, guess};
  for (int k = 0; k < 2; ++k) {
    const SolverSettings settings = test::solver_settings(test::both_solvers[k], 1e-10, 50000);
    const SolverReport report = solve(problem, settings, workspace, solutions[k]);
    EXPECT_TRUE(report.converged) << test::name_of(settings.kind) << " " << report.residual.eta;
  }
  alike = workspace.accelerated.linearisation.are_alike;
  return test::difference(problem, solutions[0], solutions[1]);
}

constexpr double allowed_difference = 0.8e-6 * 9.81 * test::time_step;  // m/s

class Packing : public testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Seeds, Packing, testing::Range(1, 61));

// Forces of a frictional packing are not unique, but velocities are.
TEST_P(Packing, solvers_agree_on_velocities) {
  const test::FrozenStep frozen = packing(static_cast<std::uint64_t>(GetParam()));
  ASSERT_GT(frozen.problem.contact_count(), 10);
  bool alike = false;
  EXPECT_LT(difference_of_solvers(frozen.problem, frozen.guess, alike), allowed_difference);
}

// A workspace hides no state: repeating a solve, also after other problems, is bit-identical.
TEST_P(Packing, the_same_problem_has_the_same_bits) {
  const auto seed = static_cast<std::uint64_t>(GetParam());
  const test::FrozenStep frozen = packing(seed);
  const test::FrozenStep other = packing(seed + 1);
  for (SolverKind kind : test::both_solvers) {
    const SolverSettings settings = test::solver_settings(kind, 1e-8, 500);
    SolverWorkspace fresh, used;
    ContactSolution first = frozen.guess;
    ContactSolution second = frozen.guess;
    ContactSolution elsewhere = other.guess;
    const SolverReport report = solve(frozen.problem, settings, fresh, first);
    solve(other.problem, settings, used, elsewhere);
    const SolverReport again = solve(frozen.problem, settings, used, second);
    EXPECT_EQ(report.iterations, again.iterations) << test::name_of(kind);
    EXPECT_EQ(report.residual.eta, again.residual.eta) << test::name_of(kind);
    for (auto field : {&ContactSolution::pn, &ContactSolution::pt, &ContactSolution::vx, &ContactSolution::vy,
                       &ContactSolution::omega})
      EXPECT_EQ(first.*field, second.*field) << test::name_of(kind);
  }
}

ContactSolution solved(const ContactProblem& problem, ContactSolution guess, SolverWorkspace& workspace) {
  if (!problem.resists_rolling()) guess.pr.clear();
  solve(problem, test::solver_settings(SolverKind::accelerated, 1e-8, 100), workspace, guess);
  return guess;
}

/// Expects a workspace to solve each of two problems with the bits of a new one, whichever it solved before.
void expect_no_memory(const ContactProblem& one, const ContactProblem& other, const ContactSolution& guess) {
  SolverWorkspace fresh, used;
  const ContactSolution first = solved(other, guess, fresh), before = solved(one, guess, used),
                        second = solved(other, guess, used), after = solved(one, guess, used);
  for (auto field : {&ContactSolution::pn, &ContactSolution::pr, &ContactSolution::omega}) {
    EXPECT_EQ(first.*field, second.*field);
    EXPECT_EQ(before.*field, after.*field);
  }
}

// Data that a workspace keeps for the same contacts are not used if anything else has changed.
TEST_P(Packing, the_same_contacts_of_other_bodies_have_the_same_bits) {
  const test::FrozenStep frozen = packing(static_cast<std::uint64_t>(GetParam()));
  for (auto field : {&ContactProblem::mu, &ContactProblem::inverse_mass, &ContactProblem::inverse_inertia,
                     &ContactProblem::lever})
    // Change all entries, or every second one.
    for (const std::size_t stride : {1U, 2U}) {
      ContactProblem other = frozen.problem;
      for (std::size_t i = 0; i < (other.*field).size(); i += stride) (other.*field)[i] *= 0.9;
      expect_no_memory(frozen.problem, other, frozen.guess);
    }
}

class RollingPacking : public testing::TestWithParam<int> {
 protected:
  const test::FrozenStep frozen_ =
      packing(static_cast<std::uint64_t>(GetParam()), GetParam() % 2 == 0 ? 0.05 : 0.3);
};

INSTANTIATE_TEST_SUITE_P(Seeds, RollingPacking, testing::Range(1, 13));

TEST_P(RollingPacking, solvers_agree_on_velocities) {
  bool alike = false;
  EXPECT_LT(difference_of_solvers(frozen_.problem, frozen_.guess, alike), allowed_difference);
}

TEST_P(RollingPacking, data_of_contacts_with_free_or_weaker_rolling_are_not_used) {
  ContactProblem less = frozen_.problem, free = frozen_.problem;
  for (double& mu_r : less.rolling_friction) mu_r *= 0.5;
  free.rolling_friction.clear();
  for (const ContactProblem& other : {less, free}) expect_no_memory(frozen_.problem, other, frozen_.guess);
}

// Sweeps use a faster path if all contacts have the same friction and all bodies are disks.
TEST(UnlikeContacts, are_solved_to_the_velocities_of_the_reference) {
  for (const std::uint64_t seed : {3U, 5U, 6U}) {
    const test::FrozenStep frozen = packing(seed);
    bool alike = false;
    EXPECT_LT(difference_of_solvers(frozen.problem, frozen.guess, alike), allowed_difference);
    EXPECT_TRUE(alike);
    ContactProblem of_two_frictions = frozen.problem;
    for (std::size_t c = 0; c < of_two_frictions.mu.size(); c += 2) of_two_frictions.mu[c] = 0.2;
    EXPECT_LT(difference_of_solvers(of_two_frictions, frozen.guess, alike), allowed_difference);
    EXPECT_FALSE(alike);
    ContactProblem of_others = frozen.problem;
    for (double& inverse_inertia : of_others.inverse_inertia) inverse_inertia *= 0.6;
    EXPECT_LT(difference_of_solvers(of_others, frozen.guess, alike), allowed_difference);
    EXPECT_FALSE(alike);
  }
}

// The residual is that of the bodies, whatever rows the sweeps assign to them.
TEST(Columns, are_solved) {
  const ContactProblem problem = test::columns_problem(3, 100, 60);
  SolverWorkspace workspace;
  ContactSolution solution = test::no_guess(problem);
  const SolverReport report =
      solve(problem, test::solver_settings(SolverKind::accelerated, 1e-3, 2000), workspace, solution);
  EXPECT_TRUE(report.converged) << report.residual.eta;
  EXPECT_TRUE(workspace.accelerated.linearisation.order.by_columns);
  EXPECT_LE(natural_map_residual(problem, solution).eta, 1.001e-3);
}

TEST(Columns, that_change_give_a_new_order) {
  const ContactProblem problem = test::columns_problem(3, 100, 60);
  ContactProblem turned = problem;
  for (Index& column : turned.column) column = (column + 1) % 100;
  expect_no_memory(problem, turned, test::no_guess(problem));
  SolverWorkspace one, other;
  EXPECT_NE(solved(turned, test::no_guess(problem), one).pn,
            solved(problem, test::no_guess(problem), other).pn)
      << "otherwise this tests nothing";
}

}  // namespace
}  // namespace talus::solver
