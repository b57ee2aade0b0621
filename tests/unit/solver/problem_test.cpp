#include "solver/problem.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/random.h"
#include "unit/solver/small_problems.h"

namespace talus::solver {
namespace {

/// Problem in dense form, from the definitions: U = W P + b, W = H^T M^-1 H, b = H^T v_free + c. Row 2 c of
/// H^T is the normal, row 2 c + 1 the tangent; columns 3 i + (x, y, rotation).
struct DenseProblem {
  Eigen::MatrixXd Ht, W;
  Eigen::VectorXd inverse_mass, free_velocity, c, b;
};

DenseProblem dense(const ContactProblem& problem) {
  const Index rows = 2 * problem.contact_count();
  const Index columns = 3 * problem.body_count();
  DenseProblem d{Eigen::MatrixXd::Zero(rows, columns),
                 {},
                 Eigen::VectorXd(columns),
                 Eigen::VectorXd(columns),
                 Eigen::VectorXd(rows),
                 {}};
  for (Index i = 0; i < problem.body_count(); ++i) {
    d.inverse_mass.segment(3 * i, 3) << problem.inverse_mass[i], problem.inverse_mass[i],
        problem.inverse_inertia[i];
    d.free_velocity.segment(3 * i, 3) << problem.vx[i], problem.vy[i], problem.omega[i];
  }
  for (Index k = 0; k < problem.contact_count(); ++k) {
    const Index a = problem.a[k];
    const Index b = problem.b[k];
    const Eigen::RowVector2d n(problem.nx[k], problem.ny[k]);
    const Eigen::RowVector2d t(-n.y(), n.x());
    d.Ht.block(2 * k, 3 * a, 1, 2) = -n;
    d.Ht.block(2 * k, 3 * b, 1, 2) = n;
    d.Ht.block(2 * k + 1, 3 * a, 1, 2) = -t;
    d.Ht.block(2 * k + 1, 3 * b, 1, 2) = t;
    // The contact point is at +r n on a and at -r n on b, so both rim velocities contribute -r omega.
    d.Ht(2 * k + 1, 3 * a + 2) = -problem.lever[a];
    d.Ht(2 * k + 1, 3 * b + 2) = -problem.lever[b];
    d.c.segment(2 * k, 2) << problem.cn[k], problem.ct[k];
  }
  d.W = d.Ht * d.inverse_mass.asDiagonal() * d.Ht.transpose();
  d.b = d.Ht * d.free_velocity + d.c;
  return d;
}

ContactSolution random_impulses(const ContactProblem& problem, std::uint64_t seed) {
  ContactSolution solution = test::no_guess(problem);
  Random random(seed);
  for (double& pn : solution.pn) pn = random.uniform(0.0, 1.0);
  for (double& pt : solution.pt) pt = random.uniform(-1.0, 1.0);
  return solution;
}

TEST(Problem, relative_velocities_are_W_P_plus_b) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const ContactProblem problem = test::random_problem(seed, 12, 25);
    const DenseProblem d = dense(problem);
    ContactSolution solution = random_impulses(problem, seed);
    Eigen::VectorXd P(2 * problem.contact_count());
    for (Index c = 0; c < problem.contact_count(); ++c) P.segment(2 * c, 2) << solution.pn[c], solution.pt[c];
    const Eigen::VectorXd U = d.W * P + d.b;
    velocities_from_impulses(problem, solution);
    for (Index c = 0; c < problem.contact_count(); ++c) {
      const RelativeVelocity u = relative_velocity(problem, solution, c);
      EXPECT_NEAR(u.normal, U[2 * c], 1e-13);
      EXPECT_NEAR(u.tangential, U[2 * c + 1], 1e-13);
    }
  }
}

TEST(Problem, the_delassus_diagonal_is_that_of_W_and_its_blocks_are_diagonal) {
  const ContactProblem problem = test::random_problem(3, 12, 25);
  const DenseProblem d = dense(problem);
  for (Index c = 0; c < problem.contact_count(); ++c) {
    const DelassusDiagonal w = delassus_diagonal(problem, c);
    EXPECT_NEAR(w.normal, d.W(2 * c, 2 * c), 1e-13);
    EXPECT_NEAR(w.tangential, d.W(2 * c + 1, 2 * c + 1), 1e-13);
    EXPECT_NEAR(d.W(2 * c, 2 * c + 1), 0.0, 1e-15);
  }
}

// W_tt = 3 W_nn for two solid disks.
TEST(Problem, solid_disks_are_three_times_softer_along_the_tangent) {
  ContactProblem problem;
  test::add_body(problem, 2.0, 0.1, 0.0, 0.0, 0.0);
  test::add_body(problem, 5.0, 0.3, 0.0, 0.0, 0.0);
  test::add_contact(problem, 0, 1, 1.0, 0.0, 0.5);
  const DelassusDiagonal w = delassus_diagonal(problem, 0);
  EXPECT_DOUBLE_EQ(w.normal, 0.7);
  EXPECT_DOUBLE_EQ(w.tangential, 2.1);
}

// Signs: b moves away from a along n, and along t; counter-clockwise rotation moves both rims in the negative
// direction.
TEST(Problem, relative_velocities_have_the_signs_of_the_convention) {
  ContactProblem problem;
  test::add_body(problem, 1.0, 0.25, 1.0, 0.0, 3.0);
  test::add_body(problem, 1.0, 0.5, 3.0, 7.0, 4.0);
  test::add_contact(problem, 0, 1, 1.0, 0.0, 0.5, 10.0, 100.0);
  ContactSolution solution = test::no_guess(problem);
  velocities_from_impulses(problem, solution);
  const RelativeVelocity u = relative_velocity(problem, solution, 0);
  EXPECT_DOUBLE_EQ(u.normal, 2.0 + 10.0);
  EXPECT_DOUBLE_EQ(u.tangential, 7.0 - (0.25 * 3.0 + 0.5 * 4.0) + 100.0);
}

TEST(Problem, impulses_push_b_along_the_normal_and_a_back) {
  ContactProblem problem;
  test::add_body(problem, 2.0, 0.5, 0.0, 0.0, 0.0);
  test::add_body(problem, 4.0, 0.25, 0.0, 0.0, 0.0);
  test::add_contact(problem, 0, 1, 0.0, 1.0, 0.5);  // t = (-1, 0)
  ContactSolution solution = test::no_guess(problem);
  solution.pn = {8.0};
  solution.pt = {1.0};
  velocities_from_impulses(problem, solution);
  EXPECT_EQ(solution.vx, (std::vector<double>{0.5, -0.25}));
  EXPECT_EQ(solution.vy, (std::vector<double>{-4.0, 2.0}));
  // Both torques are -r P_t, with I = m r^2 / 2 = 0.25 and 0.125.
  EXPECT_EQ(solution.omega, (std::vector<double>{-2.0, -2.0}));
}

}  // namespace
}  // namespace talus::solver
