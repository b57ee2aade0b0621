#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "contact/detection.h"
#include "core/trigonometry.h"
#include "dynamics/step.h"
#include "support/scenes.h"

namespace talus::dynamics {
namespace {

constexpr double h = 1e-3;
constexpr double tolerance = 1e-4;

Contacts contacts_of(const World& world, double margin) {
  Contacts contacts;
  contact::NeighbourList list;
  contact::detect_contacts(list, world.grains, world.boundary, margin, contacts);
  return contacts;
}

/// Disk above the plane y = 0 with the given gap and velocity, and its contact problem.
struct Scene {
  World world = test::disk_on_plane(0.0);
  ContactLawParameters law;
  solver::ContactProblem problem;
  std::vector<double> fn, ft;  ///< remembered forces of the first contacts, N; the others have none

  explicit Scene(double gap, double vy = 0.0) {
    world.grains.y[0] += gap;
    world.grains.vy[0] = vy;
  }
  void form_now() {
    Contacts contacts = contacts_of(world, 1.0);
    std::copy(fn.begin(), fn.end(), contacts.fn.begin());
    std::copy(ft.begin(), ft.end(), contacts.ft.begin());
    form_problem(world, contacts, law, h, tolerance, problem);
  }
  /// Gives the contact with the plane a force whose error, at the given tolerance, changes the velocity of
  /// the disk by this amount in a step.
  Scene& remembering(double noise_velocity) {
    fn = {noise_velocity / (tolerance * h * world.grains.inverse_mass[0])};
    return *this;
  }
  double normal_constant() {
    form_now();
    return problem.cn[0];
  }
};

TEST(FormProblem, free_velocities_are_those_of_free_fall) {
  Scene scene(0.1, 2.0);
  scene.world.tilt = radians(30.0);
  scene.world.grains.vx[0] = 3.0;
  scene.world.grains.omega[0] = 7.0;
  add_disk(scene.world.grains, {0.5, -0.1}, 0.01, test::density, true);
  scene.form_now();
  const solver::ContactProblem& p = scene.problem;
  ASSERT_EQ(p.body_count(), 3);  // the disk, the glued grain, the plane
  EXPECT_DOUBLE_EQ(p.vx[0], 3.0 + h * 9.81 * 0.5);
  EXPECT_DOUBLE_EQ(p.vy[0], 2.0 - h * 9.81 * cosine(radians(30.0)));
  EXPECT_EQ(p.omega[0], 7.0);
  EXPECT_EQ(p.lever[0], test::radius);
  for (Index i : {1, 2}) {
    EXPECT_EQ(p.vx[i], 0.0);
    EXPECT_EQ(p.vy[i], 0.0);
    EXPECT_EQ(p.omega[i], 0.0);
    EXPECT_EQ(p.inverse_mass[i], 0.0);
    EXPECT_EQ(p.inverse_inertia[i], 0.0);
  }
  EXPECT_EQ(p.lever[2], 0.0);
}

TEST(FormProblem, an_open_gap_enters_as_gap_over_h) {
  EXPECT_NEAR(Scene(2e-4).normal_constant(), 0.2, 1e-13);
}

TEST(FormProblem, a_share_of_an_overlap_is_taken_back) {
  Scene scene(-2e-4);
  scene.law.overlap_correction = 0.25;
  EXPECT_NEAR(scene.normal_constant(), -0.05, 1e-13);
  scene.law.overlap_correction = 0.0;
  EXPECT_EQ(scene.normal_constant(), 0.0);
}

// 0.25 of 2e-4 - 1e-5 in 1e-3 s gives 0.0475 m/s; 0.25 of the excess over ten allowed overlaps gives 0.025
// m/s.
TEST(FormProblem, an_overlap_is_taken_back_as_slowly_as_it_may_arise) {
  Scene scene(-2e-4);
  scene.law.overlap_correction = 0.25;
  scene.law.allowed_overlap = 1e-5;
  EXPECT_NEAR(scene.remembering(0.1).normal_constant(), -0.0475, 1e-13);
  EXPECT_NEAR(scene.remembering(0.03).normal_constant(), -0.03, 1e-13);
  EXPECT_NEAR(scene.remembering(0.01).normal_constant(), -0.025, 1e-13);
  EXPECT_NEAR(scene.remembering(0.0).normal_constant(), -0.025, 1e-13);
}

TEST(FormProblem, nothing_allowed_is_no_noise) {
  Scene gap(2e-4), overlap(-2e-4);
  overlap.law.overlap_correction = 0.25;
  EXPECT_NEAR(gap.remembering(0.01).normal_constant(), 0.2, 1e-13);
  EXPECT_NEAR(overlap.remembering(0.01).normal_constant(), -0.05, 1e-13);
}

TEST(FormProblem, an_allowed_overlap_stays) {
  Scene scene(-2e-4);
  scene.law.allowed_overlap = 3e-4;
  EXPECT_EQ(scene.remembering(0.1).normal_constant(), 0.0);
}

// The full 2e-4 in 1e-3 s gives 0.2 m/s; the excess over a twentieth of an allowed overlap gives 0.1 m/s.
TEST(FormProblem, a_small_gap_that_bears_load_closes_as_slowly_as_it_may_arise) {
  Scene scene(2e-4);
  scene.law.allowed_overlap = 2e-3;
  EXPECT_NEAR(scene.remembering(0.3).normal_constant(), 0.2, 1e-13);
  EXPECT_NEAR(scene.remembering(0.15).normal_constant(), 0.15, 1e-13);
  EXPECT_NEAR(scene.remembering(0.01).normal_constant(), 0.1, 1e-13);
  EXPECT_NEAR(scene.remembering(0.0).normal_constant(), 0.2, 1e-13);
}

// With forces of 3 N along and 4 N across the contact with the plane, the error of an impulse is 5e-4 N h.
// The glued grain has a gap and no force, and does not count.
TEST(FormProblem, the_error_of_an_impulse_is_relative_to_the_rms_of_those_that_bear_load) {
  Scene scene(-2e-4);
  add_disk(scene.world.grains, {0.1 + 2.2 * test::radius, test::radius}, test::radius, test::density, true);
  scene.law.overlap_correction = 1.0;
  scene.law.allowed_overlap = 1e-4;
  scene.form_now();
  ASSERT_EQ(scene.problem.contact_count(), 2);
  const Index plane = scene.problem.b[0] == 2 ? 0 : 1;
  scene.fn = scene.ft = {0.0, 0.0};
  scene.fn[plane] = 3.0;
  scene.ft[plane] = 4.0;
  scene.form_now();
  EXPECT_NEAR(scene.problem.cn[plane], -5.0 * tolerance * h * scene.world.grains.inverse_mass[0], 1e-12);
  EXPECT_GT(scene.problem.cn[1 - plane], 0.1);
}

// Restitution requires U_n >= -e U_n-, so c_n = e U_n-: -0.5 at 1 m/s and e = 0.5.
TEST(FormProblem, restitution_enters_where_the_contact_closes_within_the_step) {
  Scene closes(2e-4, -1.0);
  closes.law.restitution = 0.5;
  EXPECT_NEAR(closes.normal_constant(), -0.5, 1e-13);
  Scene stays_open(2e-3, -1.0);
  stays_open.law.restitution = 0.5;
  EXPECT_NEAR(stays_open.normal_constant(), 2.0, 1e-12);
  Scene parts(-1e-6, 1.0);
  parts.law.restitution = 0.5;
  parts.law.overlap_correction = 0.0;
  EXPECT_EQ(parts.normal_constant(), 0.0);
}

// c_t = e_t U_t-, with U_t of the plane seen from the disk: along t = (1, 0), -v_x - r omega.
TEST(FormProblem, tangential_restitution_enters_where_the_contact_closes) {
  Scene scene(0.0, -1.0);
  scene.world.grains.vx[0] = 2.0;
  scene.world.grains.omega[0] = 100.0;
  scene.law.tangential_restitution = 0.5;
  scene.form_now();
  EXPECT_NEAR(scene.problem.ct[0], 0.5 * (-2.0 - 100.0 * test::radius), 1e-14);
  scene.world.grains.y[0] += 0.5;
  scene.form_now();
  EXPECT_EQ(scene.problem.ct[0], 0.0);
}

// Large beds are swept by columns, so contacts must connect only neighbouring columns.
TEST(FormProblem, contacts_of_a_large_bed_join_columns_next_to_each_other) {
  const World world = test::random_cloud(5, 20'000, true, 300.0 * test::radius);
  const Contacts contacts = contacts_of(world, 0.1 * test::radius);
  solver::ContactProblem problem;
  form_problem(world, contacts, {}, h, tolerance, problem);
  ASSERT_EQ(problem.column.size(), problem.vx.size());
  const Index columns = problem.columns;
  EXPECT_EQ(*std::ranges::max_element(problem.column), columns - 1);
  EXPECT_GT(columns, 25);
  EXPECT_EQ(*std::ranges::min_element(problem.column), 0);
  Index across_the_edge = 0;
  for (Index c = 0; c < problem.contact_count(); ++c) {
    const Index apart = std::abs(problem.column[problem.a[c]] - problem.column[problem.b[c]]);
    EXPECT_TRUE(apart <= 1 || apart == columns - 1);
    across_the_edge += apart > 1 ? 1 : 0;
  }
  EXPECT_GT(across_the_edge, 0);
  ThreadTeam team(3);
  solver::ContactProblem together;
  form_problem(world, contacts, {}, h, tolerance, together, &team);
  EXPECT_EQ(together.column, problem.column);
}

TEST(FormProblem, what_has_left_a_large_bed_has_a_column) {
  World world = test::random_cloud(5, 20'000, false, 300.0 * test::radius);
  const Contacts contacts = contacts_of(world, 0.1 * test::radius);
  world.grains.x[0] = -1.0;
  world.grains.x[1] = 1e12;
  world.grains.x[2] = std::numeric_limits<double>::quiet_NaN();
  solver::ContactProblem problem;
  form_problem(world, contacts, {}, h, tolerance, problem);
  EXPECT_EQ(problem.column[0], 0);
  EXPECT_EQ(problem.column[1], problem.columns - 1);
  EXPECT_EQ(problem.column[2], 0);
}

TEST(FormProblem, a_small_bed_has_no_columns) {
  const World world = test::random_cloud(5, 900, true, 300.0 * test::radius);
  const Contacts contacts = contacts_of(world, 0.1 * test::radius);
  solver::ContactProblem problem;
  problem.column = {1, 2, 3};  // left over from a larger problem
  problem.columns = 4;
  form_problem(world, contacts, {}, h, tolerance, problem);
  EXPECT_TRUE(problem.column.empty());
  EXPECT_EQ(problem.columns, 0);
}

TEST(FormProblem, walls_have_the_friction_of_walls) {
  Scene scene(0.0);
  scene.law.friction = 0.4;
  scene.law.wall_friction = 0.1;
  scene.world.boundary.planes.push_back({{1.0, 0.0}, 0.0, true});
  add_disk(scene.world.grains, {0.1, 3.0 * test::radius}, test::radius, test::density, true);
  scene.form_now();
  ASSERT_EQ(scene.problem.contact_count(), 3);
  EXPECT_EQ(scene.problem.mu, (std::vector<double>{0.4, 0.4, 0.1}));
  EXPECT_FALSE(scene.problem.resists_rolling());
  scene.law.rolling_friction = 0.2;  // between grains and with the floor; walls do not resist rolling
  scene.form_now();
  EXPECT_EQ(scene.problem.rolling_friction, (std::vector<double>{0.2, 0.2, 0.0}));
}

}  // namespace
}  // namespace talus::dynamics
