#include "problems/siconos_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "problems/local_solvers.h"
#include "unit/solver/small_problems.h"

namespace talus::problems {
namespace {

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
