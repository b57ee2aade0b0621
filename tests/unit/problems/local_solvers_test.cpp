/// Solvers of local problems, and the error of Siconos.

#include "problems/local_solvers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "solver/local_problem.h"
#include "support/scenes.h"
#include "unit/solver/small_problems.h"

namespace talus::problems {
namespace {

solver::SolverSettings settings_of(solver::SolverKind kind, double tolerance) {
  return test::solver_settings(kind, tolerance, 50000);
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
    EXPECT_TRUE(
        test::solve_to(solver::SolverKind::gauss_seidel, frozen.problem, of_bodies, 1e-10, 50000).converged);
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

/// Returns two contacts, with W divided by `stiffness`.
solver::LocalProblem two_contacts(double stiffness) {
  const double w[4][4] = {
      {2.0, 0.3, 0.5, 0.1}, {0.3, 4.0, -0.2, 0.6}, {0.5, -0.2, 3.0, -0.4}, {0.1, 0.6, -0.4, 5.0}};
  std::vector<solver::MatrixEntry> entries;
  for (Index row = 0; row < 4; ++row)
    for (Index column = 0; column < 4; ++column) entries.push_back({row, column, w[row][column] / stiffness});
  return solver::local_problem(entries, {{-1.0, 0.4}, {-0.2, 0.7}}, {0.5, 0.3});
}

// Expected values were computed by fc2d_compute_error of Siconos 4.4.0, with its norm set to || q ||.
TEST(SiconosError, is_that_of_siconos) {
  const solver::LocalProblem problem = two_contacts(1.0);
  EXPECT_NEAR(siconos_error(problem, {{0.6, -0.1}, {0.2, 0.05}}), 0.28263343185959744, 1e-15);
  EXPECT_NEAR(siconos_error(problem, {{0.0, 0.0}, {0.0, 0.0}}), 0.70362428100540142, 1e-15);
  EXPECT_NEAR(siconos_error(problem, {{60.0, -10.0}, {20.0, 5.0}}), 0.40709574386144221, 1e-15);
  EXPECT_NEAR(siconos_error(problem, {{0.001, 0.0}, {0.0, 0.0001}}), 0.70220113596808331, 1e-15);
  EXPECT_NEAR(siconos_error(problem, {{-0.3, 0.2}, {0.1, -0.4}}), 0.66449070474440519, 1e-15);
  // Impulses that dominate the velocities.
  EXPECT_NEAR(siconos_error(two_contacts(100.0), {{60.0, -10.0}, {20.0, 5.0}}), 0.021113953450337751, 1e-15);
}

TEST(SiconosError, is_the_same_from_bodies) {
  const solver::ContactProblem problem = test::random_problem(8, 12, 25);
  solver::ContactSolution solution = test::no_guess(problem);
  Random random(8);
  for (double& pn : solution.pn) pn = random.uniform(0.0, 1.0);
  solver::velocities_from_impulses(problem, solution);
  const double expected =
      siconos_error(solver::local_problem(problem), solver::local_form(problem, solution).p);
  EXPECT_GT(expected, 0.01);
  EXPECT_NEAR(siconos_error(problem, solution), expected, 1e-13);
}

TEST(SiconosError, vanishes_where_the_natural_map_does) {
  const solver::LocalProblem problem = solver::local_problem(test::one_contact(0.6, 0.1));
  solver::LocalSolution solution;
  solution.p.resize(1);
  solver::SolverSettings settings;
  settings.tolerance = 1e-15;
  solve(problem, settings, solution);
  EXPECT_NEAR(solution.p[0].normal, 2.0, 1e-14);
  EXPECT_LT(siconos_error(problem, solution.p), 1e-14);
}

TEST(SiconosError, of_nothing_is_zero) {
  EXPECT_EQ(siconos_error(solver::ContactProblem{}, solver::ContactSolution{}), 0.0);
}

}  // namespace
}  // namespace talus::problems
