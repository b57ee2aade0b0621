/// Both solvers on dozens of small packings, falling and at rest.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solver/solve.h"
#include "support/scenes.h"
#include "unit/solver/small_problems.h"

namespace talus::solver {
namespace {

/// Returns the packing of a seed: periodic or walled, with and without friction, moving or at rest. Every
/// fifth has restitution, at the moment when its first grains reach the floor.
test::FrozenStep packing(std::uint64_t seed) {
  dynamics::StepSettings settings = test::bed_step(1e-8, seed % 4 == 0 ? 0.0 : 0.5);
  settings.law.restitution = seed % 5 == 0 ? 0.5 : 0.0;
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

double largest_difference(const std::vector<double>& one, const std::vector<double>& other) {
  double largest = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) largest = std::max(largest, std::fabs(one[i] - other[i]));
  return largest;
}

SolverSettings settings_of(SolverKind kind, double tolerance, int max_iterations) {
  SolverSettings settings;
  settings.kind = kind;
  settings.tolerance = tolerance;
  settings.max_iterations = max_iterations;
  return settings;
}

class Packing : public testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Seeds, Packing, testing::Range(1, 61));

// Forces of a frictional packing are not unique, but velocities are.
TEST_P(Packing, solvers_agree_on_velocities) {
  const test::FrozenStep frozen = packing(static_cast<std::uint64_t>(GetParam()));
  ASSERT_GT(frozen.problem.contact_count(), 10);
  SolverWorkspace workspace;
  ContactSolution reference = frozen.guess;
  ContactSolution accelerated = frozen.guess;
  const SolverReport first =
      solve(frozen.problem, settings_of(SolverKind::gauss_seidel, 1e-10, 50000), workspace, reference);
  const SolverReport second =
      solve(frozen.problem, settings_of(SolverKind::accelerated, 1e-10, 50000), workspace, accelerated);
  EXPECT_TRUE(first.converged) << first.residual.eta;
  EXPECT_TRUE(second.converged) << second.residual.eta;
  const double fall = 9.81 * test::time_step;
  const double rim = 0.5 * dynamics::BedPlan{}.mean_diameter;
  const double difference = std::max({largest_difference(reference.vx, accelerated.vx),
                                      largest_difference(reference.vy, accelerated.vy),
                                      rim * largest_difference(reference.omega, accelerated.omega)});
  EXPECT_LT(difference, 1e-6 * fall);
  RecordProperty("difference_over_gh", std::to_string(difference / fall * 1e9) + "e-9");
  RecordProperty("sweeps", std::to_string(first.iterations) + "/" + std::to_string(second.iterations));
}

// A workspace hides no state: repeating a solve, also after other problems, is bit-identical.
TEST_P(Packing, the_same_problem_has_the_same_bits) {
  const auto seed = static_cast<std::uint64_t>(GetParam());
  const test::FrozenStep frozen = packing(seed);
  const test::FrozenStep other = packing(seed + 1);
  for (SolverKind kind : test::both_solvers) {
    const SolverSettings settings = settings_of(kind, 1e-8, 500);
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

// Data that a workspace keeps for the same contacts are not used if anything else has changed.
TEST_P(Packing, the_same_contacts_of_other_bodies_have_the_same_bits) {
  const test::FrozenStep frozen = packing(static_cast<std::uint64_t>(GetParam()));
  const SolverSettings settings = settings_of(SolverKind::accelerated, 1e-8, 100);
  for (auto field : {&ContactProblem::mu, &ContactProblem::inverse_mass, &ContactProblem::inverse_inertia,
                     &ContactProblem::lever})
    // Change all entries, or every second one.
    for (const std::size_t stride : {1U, 2U}) {
      ContactProblem other = frozen.problem;
      for (std::size_t i = 0; i < (other.*field).size(); i += stride) (other.*field)[i] *= 0.9;
      SolverWorkspace fresh, used;
      ContactSolution first = frozen.guess, second = frozen.guess, before = frozen.guess,
                      after = frozen.guess;
      solve(other, settings, fresh, first);
      solve(frozen.problem, settings, used, before);
      solve(other, settings, used, second);
      solve(frozen.problem, settings, used, after);
      EXPECT_EQ(first.pn, second.pn);
      EXPECT_EQ(first.omega, second.omega);
      EXPECT_EQ(before.pn, after.pn);
      EXPECT_EQ(before.omega, after.omega);
    }
}

/// Returns the largest difference of velocities between the two solvers, both to 1e-10; `alike` is set to
/// whether the accelerated one recognised the contacts as alike.
double difference_of_solvers(const ContactProblem& problem, const ContactSolution& guess, bool& alike) {
  SolverWorkspace workspace;
  ContactSolution reference = guess, accelerated = guess;
  EXPECT_TRUE(
      solve(problem, settings_of(SolverKind::gauss_seidel, 1e-10, 50000), workspace, reference).converged);
  EXPECT_TRUE(
      solve(problem, settings_of(SolverKind::accelerated, 1e-10, 50000), workspace, accelerated).converged);
  alike = workspace.accelerated.linearisation.are_alike;
  return std::max(
      {largest_difference(reference.vx, accelerated.vx), largest_difference(reference.vy, accelerated.vy),
       0.5 * dynamics::BedPlan{}.mean_diameter * largest_difference(reference.omega, accelerated.omega)});
}

// Sweeps use a faster path if all contacts have the same friction and all bodies are disks.
TEST(UnlikeContacts, are_solved_to_the_velocities_of_the_reference) {
  const double admissible = 1e-6 * 9.81 * test::time_step;
  for (const std::uint64_t seed : {3U, 5U, 6U}) {
    const test::FrozenStep frozen = packing(seed);
    bool alike = false;
    EXPECT_LT(difference_of_solvers(frozen.problem, frozen.guess, alike), admissible);
    EXPECT_TRUE(alike);
    ContactProblem of_two_frictions = frozen.problem;
    for (std::size_t c = 0; c < of_two_frictions.mu.size(); c += 2) of_two_frictions.mu[c] = 0.2;
    EXPECT_LT(difference_of_solvers(of_two_frictions, frozen.guess, alike), admissible);
    EXPECT_FALSE(alike);
    ContactProblem of_others = frozen.problem;
    for (double& inverse_inertia : of_others.inverse_inertia) inverse_inertia *= 0.6;
    EXPECT_LT(difference_of_solvers(of_others, frozen.guess, alike), admissible);
    EXPECT_FALSE(alike);
  }
}

// The residual is that of the bodies, whatever rows the sweeps assign to them.
TEST(Columns, are_solved) {
  const ContactProblem problem = test::columns_problem(3, 100, 60);
  SolverWorkspace workspace;
  ContactSolution solution = test::no_guess(problem);
  const SolverReport report =
      solve(problem, settings_of(SolverKind::accelerated, 1e-3, 2000), workspace, solution);
  EXPECT_TRUE(report.converged) << report.residual.eta;
  EXPECT_TRUE(workspace.accelerated.linearisation.order.by_columns);
  EXPECT_LE(natural_map_residual(problem, solution).eta, 1.001e-3);
}

TEST(Columns, that_change_give_a_new_order) {
  const ContactProblem problem = test::columns_problem(3, 100, 60);
  ContactProblem turned = problem;
  for (Index& column : turned.column) column = (column + 1) % 100;
  const SolverSettings settings = settings_of(SolverKind::accelerated, 1e-8, 20);
  SolverWorkspace fresh, used;
  ContactSolution first = test::no_guess(problem), second = first, before = first;
  solve(turned, settings, fresh, first);
  solve(problem, settings, used, before);
  solve(turned, settings, used, second);
  EXPECT_EQ(first.pn, second.pn);
  EXPECT_EQ(first.omega, second.omega);
  EXPECT_NE(first.pn, before.pn) << "otherwise this tests nothing";
}

}  // namespace
}  // namespace talus::solver
