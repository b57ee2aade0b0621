/// Contact problems, of bodies and in local form.

#include "solver/problem.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/random.h"
#include "solver/local_problem.h"
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

/// Computes column d of W from its definition: the difference of velocities with and without a unit impulse.
/// The bodies are moved one by one, without forming H^T M^-1 H.
std::vector<RelativeVelocity> column_of_W(const ContactProblem& problem, Index d, bool tangential) {
  ContactSolution push = test::no_guess(problem);
  (tangential ? push.pt : push.pn)[d] = 1.0;
  velocities_from_impulses(problem, push);
  std::vector<RelativeVelocity> column;
  for (Index c = 0; c < problem.contact_count(); ++c) {
    const RelativeVelocity with = relative_velocity(problem, push, c);
    const RelativeVelocity without = free_relative_velocity(problem, c);
    column.push_back({with.normal - without.normal, with.tangential - without.tangential});
  }
  return column;
}

DelassusBlock block_at(const LocalProblem& local, Index c, Index d) {
  for (Index k = local.row_begin[c]; k < local.row_begin[c + 1]; ++k)
    if (local.column[k] == d) return local.block[k];
  return {};
}

/// Expects columns of each row to ascend, and each row to have its diagonal block where `diagonal` states.
void expect_well_formed(const LocalProblem& local) {
  ASSERT_EQ(local.row_begin.size(), local.mu.size() + 1);
  for (Index c = 0; c < local.contact_count(); ++c) {
    for (Index k = local.row_begin[c] + 1; k < local.row_begin[c + 1]; ++k)
      EXPECT_LT(local.column[k - 1], local.column[k]);
    EXPECT_GE(local.diagonal[c], local.row_begin[c]);
    EXPECT_LT(local.diagonal[c], local.row_begin[c + 1]);
    EXPECT_EQ(local.column[local.diagonal[c]], c);
  }
}

TEST(LocalProblem, W_is_what_unit_impulses_do) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const ContactProblem problem = test::random_problem(seed, 9, 24);
    const LocalProblem local = local_problem(problem);
    expect_well_formed(local);
    for (Index d = 0; d < problem.contact_count(); ++d) {
      const auto normal = column_of_W(problem, d, false);
      const auto tangential = column_of_W(problem, d, true);
      for (Index c = 0; c < problem.contact_count(); ++c) {
        const DelassusBlock w = block_at(local, c, d);
        EXPECT_NEAR(w.nn, normal[c].normal, 1e-13);
        EXPECT_NEAR(w.tn, normal[c].tangential, 1e-13);
        EXPECT_NEAR(w.nt, tangential[c].normal, 1e-13);
        EXPECT_NEAR(w.tt, tangential[c].tangential, 1e-13);
      }
    }
  }
}

TEST(LocalProblem, relative_velocities_are_those_of_the_bodies) {
  const ContactProblem problem = test::random_problem(6, 12, 25);
  ContactSolution solution = random_impulses(problem, 6);
  velocities_from_impulses(problem, solution);
  const LocalSolution of_bodies = local_form(problem, solution);
  LocalSolution of_W{of_bodies.p, {}};
  velocities_from_impulses(local_problem(problem), of_W);
  for (Index c = 0; c < problem.contact_count(); ++c) {
    EXPECT_NEAR(of_W.u[c].normal, of_bodies.u[c].normal, 1e-13);
    EXPECT_NEAR(of_W.u[c].tangential, of_bodies.u[c].tangential, 1e-13);
  }
}

// An immobile floor transmits no impulse from one contact to the next.
TEST(LocalProblem, contacts_of_a_fixed_body_do_not_feel_each_other) {
  ContactProblem problem;
  test::add_body(problem, 1.0, 0.1, 0.0, 0.0, 0.0);
  test::add_body(problem, 1.0, 0.1, 0.0, 0.0, 0.0);
  test::add_body(problem, 0.0, 0.0, 0.0, 0.0, 0.0);
  test::add_contact(problem, 0, 2, 0.0, -1.0, 0.5);
  test::add_contact(problem, 1, 2, 0.0, -1.0, 0.5);
  EXPECT_EQ(local_problem(problem).block.size(), 2u);
}

TEST(LocalProblem, entries_of_any_order_become_block_rows) {
  // Two contacts; block (1, 0) is given in two parts, and the diagonal of contact 1 is missing.
  const LocalProblem local =
      local_problem({{3, 0, 0.25}, {0, 0, 2.0}, {2, 1, 7.0}, {1, 1, 3.0}, {0, 1, 0.5}, {3, 0, 0.5}},
                    {{1.0, 2.0}, {3.0, 4.0}}, {0.5, 0.25});
  expect_well_formed(local);
  ASSERT_EQ(local.block.size(), 3u);
  EXPECT_EQ(block_at(local, 0, 0).nn, 2.0);
  EXPECT_EQ(block_at(local, 0, 0).nt, 0.5);
  EXPECT_EQ(block_at(local, 0, 0).tt, 3.0);
  EXPECT_EQ(block_at(local, 1, 0).tn, 0.75);
  EXPECT_EQ(block_at(local, 1, 0).nt, 7.0);
  EXPECT_EQ(block_at(local, 1, 1).nn, 0.0);
  // u = W p + q by hand for p = (1, 10) at the first contact and (100, 1000) at the second.
  const std::vector<Impulse> p = {{1.0, 10.0}, {100.0, 1000.0}};
  EXPECT_EQ(relative_velocity(local, p, 0).normal, 1.0 + 2.0 + 5.0);
  EXPECT_EQ(relative_velocity(local, p, 0).tangential, 2.0 + 30.0);
  EXPECT_EQ(relative_velocity(local, p, 1).normal, 3.0 + 70.0);
  EXPECT_EQ(relative_velocity(local, p, 1).tangential, 4.0 + 0.75);
}

TEST(LocalProblem, of_no_contacts_is_empty) {
  expect_well_formed(local_problem(ContactProblem{}));
  expect_well_formed(local_problem({}, {}, {}));
}

}  // namespace
}  // namespace talus::solver
