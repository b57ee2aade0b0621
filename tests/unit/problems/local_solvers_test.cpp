#include "problems/local_solvers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "solver/local_law.h"
#include "support/scenes.h"
#include "unit/solver/small_problems.h"

namespace talus::problems {
namespace {

solver::SolverSettings settings_of(solver::SolverKind kind, double tolerance) {
  solver::SolverSettings settings;
  settings.kind = kind;
  settings.tolerance = tolerance;
  settings.max_iterations = 50000;
  return settings;
}

solver::LocalSolution zero(const solver::LocalProblem& problem) {
  solver::LocalSolution solution;
  solution.p.resize(problem.mu.size());
  return solution;
}

/// Returns a small packing. Closing gaps and overlaps of the size of earlier residuals make it solvable to
/// any tolerance.
test::FrozenStep packing(std::uint64_t seed) {
  const dynamics::StepSettings settings = test::bed_step(1e-8);
  World world = test::fallen_bed(test::bed_plan(seed % 2 == 0, 24, 6, seed), settings, 100);
  world.tilt = 0.02 * static_cast<double>(seed);
  test::FrozenStep frozen = test::next_problem(world, settings);
  for (double& cn : frozen.problem.cn)
    if (std::fabs(cn) < 1e-8 / settings.h) cn = 0.0;
  return frozen;
}

/// Returns W = G G^T from random blocks along a chain of contacts, with normal and tangent coupled
/// everywhere.
solver::LocalProblem coupled_chain(std::uint64_t seed, Index contacts) {
  Random random(seed);
  const Index unknowns = 2 * contacts;
  std::vector<std::vector<double>> g(static_cast<std::size_t>(unknowns));
  for (std::vector<double>& row : g)
    for (int k = 0; k < 6; ++k) row.push_back(random.uniform(-1.0, 1.0));
  std::vector<solver::MatrixEntry> entries;
  // Row i of G has columns 2 (i / 2) ... 2 (i / 2) + 5, so contacts up to two apart overlap.
  for (Index i = 0; i < unknowns; ++i)
    for (Index j = std::max(0, i - 5); j < std::min(unknowns, i + 6); ++j) {
      double sum = i == j ? 1.0 : 0.0;
      for (int k = 0; k < 6; ++k) {
        const int other = k + 2 * (i / 2) - 2 * (j / 2);
        if (other >= 0 && other < 6) sum += g[i][k] * g[j][other];
      }
      entries.push_back({i, j, sum});
    }
  std::vector<solver::RelativeVelocity> q;
  for (Index c = 0; c < contacts; ++c) q.push_back({random.uniform(-1.0, 0.3), random.uniform(-1.0, 1.0)});
  return solver::local_problem(std::move(entries), std::move(q),
                               std::vector<double>(static_cast<std::size_t>(contacts), 0.3));
}

class LocalSolver : public testing::TestWithParam<solver::SolverKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, LocalSolver, testing::ValuesIn(test::both_solvers),
                         [](const auto& kind) { return test::name_of(kind.param); });

// Forces of a packing are not unique; relative velocities are, from the same first guess.
TEST_P(LocalSolver, finds_the_velocities_of_the_bodies) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const test::FrozenStep frozen = packing(seed);
    solver::ContactSolution of_bodies = frozen.guess;
    solver::SolverWorkspace workspace;
    const solver::SolverSettings reference = settings_of(solver::SolverKind::gauss_seidel, 1e-10);
    EXPECT_TRUE(solver::solve(frozen.problem, reference, workspace, of_bodies).converged);
    const solver::LocalSolution expected = solver::local_form(frozen.problem, of_bodies);
    const solver::LocalProblem problem = solver::local_problem(frozen.problem);
    solver::LocalSolution found = zero(problem);
    for (std::size_t c = 0; c < found.p.size(); ++c) found.p[c] = {frozen.guess.pn[c], frozen.guess.pt[c]};
    const solver::SolverReport report = solve(problem, settings_of(GetParam(), 1e-10), found);
    EXPECT_TRUE(report.converged) << report.residual.eta;
    ASSERT_GT(problem.contact_count(), 10);
    double difference = 0.0;
    for (Index c = 0; c < problem.contact_count(); ++c)
      difference = std::max({difference, std::fabs(found.u[c].normal - expected.u[c].normal),
                             std::fabs(found.u[c].tangential - expected.u[c].tangential)});
    EXPECT_LT(difference, 1e-6 * 9.81 * test::time_step) << seed;
  }
}

TEST_P(LocalSolver, obeys_the_law_where_normal_and_tangent_are_coupled) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const solver::LocalProblem problem = coupled_chain(seed, 40);
    solver::LocalSolution solution = zero(problem);
    const solver::SolverReport report = solve(problem, settings_of(GetParam(), 1e-13), solution);
    ASSERT_TRUE(report.converged) << report.residual.eta;
    int carrying = 0, sliding = 0;
    for (Index c = 0; c < problem.contact_count(); ++c) {
      const solver::Impulse p = solution.p[c];
      const solver::RelativeVelocity u = solution.u[c];
      EXPECT_GE(p.normal, 0.0);
      EXPECT_GE(u.normal, -1e-11);
      EXPECT_NEAR(p.normal * u.normal, 0.0, 1e-11);
      EXPECT_LE(std::fabs(p.tangential), 0.3 * p.normal + 1e-11);
      if (p.normal > 0.0) ++carrying;
      if (p.normal > 0.0 && std::fabs(u.tangential) > 1e-9) {
        EXPECT_NEAR(p.tangential, -std::copysign(0.3 * p.normal, u.tangential), 1e-11);
        ++sliding;
      }
    }
    EXPECT_GT(carrying, 5);
    EXPECT_GT(sliding, 2);
  }
}

TEST_P(LocalSolver, leaves_a_solution_as_it_is) {
  const solver::LocalProblem problem = coupled_chain(1, 40);
  solver::LocalSolution solution = zero(problem);
  solve(problem, settings_of(GetParam(), 1e-12), solution);
  const std::vector<solver::Impulse> solved = solution.p;
  const solver::SolverReport report = solve(problem, settings_of(GetParam(), 1e-11), solution);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_TRUE(report.converged);
  for (std::size_t c = 0; c < solved.size(); ++c) EXPECT_EQ(solution.p[c].normal, solved[c].normal);
}

TEST_P(LocalSolver, stops_at_the_iterations_it_is_given_and_says_so) {
  const solver::LocalProblem problem = coupled_chain(2, 40);
  solver::LocalSolution solution = zero(problem);
  solver::SolverSettings settings = settings_of(GetParam(), 1e-15);
  settings.max_iterations = 7;
  const solver::SolverReport report = solve(problem, settings, solution);
  EXPECT_EQ(report.iterations, 7);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.residual.eta, solver::natural_map_residual(problem, solution).eta);
}

TEST_P(LocalSolver, has_nothing_to_do_without_contacts) {
  solver::LocalSolution solution;
  const solver::SolverReport report =
      solve(solver::local_problem({}, {}, {}), settings_of(GetParam(), 1e-6), solution);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_TRUE(report.converged);
}

/// Expects momentum to need less than a quarter of the sweeps from the guess.
void expect_saved_sweeps(const solver::LocalProblem& problem, const solver::LocalSolution& guess) {
  solver::LocalSolution plain = guess, fast = guess;
  const int sweeps = solve(problem, settings_of(solver::SolverKind::gauss_seidel, 1e-8), plain).iterations;
  const int with_momentum =
      solve(problem, settings_of(solver::SolverKind::accelerated, 1e-8), fast).iterations;
  EXPECT_GT(sweeps, 100);
  EXPECT_LT(4 * with_momentum, sweeps);
}

TEST(LocalSolvers, momentum_saves_sweeps) {
  const solver::LocalProblem problem =
      solver::local_problem(test::next_problem(test::column(20), test::bed_step()).problem);
  expect_saved_sweeps(problem, zero(problem));
}

// The same along the tangent: disks in a row that roll on each other, pressed together.
TEST(LocalSolvers, momentum_saves_sweeps_of_friction) {
  solver::ContactProblem row;
  constexpr Index count = 20;
  for (Index i = 0; i < count; ++i) test::add_body(row, 1.0, 0.1, 0.0, 0.0, i == 0 ? 1.0 : 0.0);
  row.inverse_mass.assign(count, 0.0);  // they can only rotate
  for (Index i = 0; i + 1 < count; ++i) test::add_contact(row, i, i + 1, 1.0, 0.0, 0.5);
  const solver::LocalProblem problem = solver::local_problem(row);
  solver::LocalSolution pressed = zero(problem);
  for (solver::Impulse& p : pressed.p) p.normal = 1.0;
  expect_saved_sweeps(problem, pressed);
}

}  // namespace
}  // namespace talus::problems
