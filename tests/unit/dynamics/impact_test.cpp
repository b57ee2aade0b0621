/// Binary impacts in discrete form: two disks that just touch at the midpoint (test::two_disks), so that the
/// lever arms meet at one point and the gap term vanishes.

#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.h"

namespace talus::dynamics {
namespace {

using test::radius;

/// Relative velocity at the contact of disks 0 and 1 with normal n from 0 to 1, computed independently.
struct ContactVelocity {
  double normal, tangential;
};
ContactVelocity relative(const Grains& g, double angle) {
  const Vec2 n{std::cos(angle), std::sin(angle)};
  const Vec2 d{g.vx[1] - g.vx[0], g.vy[1] - g.vy[0]};
  return {d.x * n.x + d.y * n.y,
          -d.x * n.y + d.y * n.x - g.radius[0] * g.omega[0] - g.radius[1] * g.omega[1]};
}

class Impact : public testing::TestWithParam<solver::SolverKind> {
 protected:
  StepSettings settings_with(double restitution, double tangential_restitution, double friction) {
    StepSettings settings = test::exact_step(GetParam(), friction);
    settings.law.restitution = restitution;
    settings.law.tangential_restitution = tangential_restitution;
    return settings;
  }
  void hit(World& world, const StepSettings& settings) {
    StepWorkspace workspace;
    step(world, settings, workspace);
    ASSERT_EQ(world.contacts.count(), 1);
    ASSERT_NEAR(world.contacts.gap[0], 0.0, 1e-15);
  }
};

INSTANTIATE_TEST_SUITE_P(Solvers, Impact, testing::ValuesIn(test::both_solvers),
                         [](const auto& parameter) { return test::name_of(parameter.param); });

TEST_P(Impact, obeys_newtons_restitution_in_every_direction) {
  for (double e : {0.0, 0.3, 0.9, 1.0})
    for (double angle : {0.0, 0.7, 2.0, -2.5}) {
      World world = test::two_disks(angle, {1.0 * std::cos(angle), 1.0 * std::sin(angle)}, {0.1, -0.2});
      world.grains.omega = {3.0, -7.0};
      const ContactVelocity before = relative(world.grains, angle);
      ASSERT_LT(before.normal, 0.0);
      hit(world, settings_with(e, 0.0, 0.5));
      EXPECT_NEAR(relative(world.grains, angle).normal, -e * before.normal, 1e-13);
    }
}

TEST_P(Impact, conserves_momentum_and_angular_momentum) {
  for (double friction : {0.0, 0.2, 5.0})
    for (double e : {0.0, 0.6, 1.0}) {
      World world = test::two_disks(0.4, {1.3, 0.2}, {-0.4, 0.5});
      world.grains.omega = {30.0, -70.0};
      const test::Momentum before = test::momentum(world.grains);
      hit(world, settings_with(e, 0.0, friction));
      const test::Momentum after = test::momentum(world.grains);
      EXPECT_NEAR(after.x, before.x, 1e-14);
      EXPECT_NEAR(after.y, before.y, 1e-14);
      EXPECT_NEAR(after.angular, before.angular, 1e-14);
    }
}

// Both moments of a contact act: one on a grain and the opposite one on the other.
TEST_P(Impact, conserves_angular_momentum_where_grains_resist_rolling) {
  for (double mu_r : {0.1, 5.0}) {
    World world = test::two_disks(0.4, {1.3, 0.2}, {-0.4, 0.5});
    world.grains.omega = {30.0, -70.0};
    const test::Momentum before = test::momentum(world.grains);
    StepSettings settings = settings_with(0.3, 0.0, 0.5);
    settings.law.rolling_friction = mu_r;
    hit(world, settings);
    const test::Momentum after = test::momentum(world.grains);
    EXPECT_NEAR(after.x, before.x, 1e-14);
    EXPECT_NEAR(after.y, before.y, 1e-14);
    EXPECT_NEAR(after.angular, before.angular, 1e-14);
    EXPECT_GT(std::fabs(world.contacts.moment[0]), 1e-6);
    if (mu_r < 1.0) continue;
    EXPECT_NEAR(world.grains.omega[0], world.grains.omega[1], 1e-9);
  }
}

// A sticking contact separates with U_t+ = -e_t U_t-.
TEST_P(Impact, tangential_restitution_turns_the_slip_around) {
  for (double et : {-1.0, 0.0, 0.4, 1.0}) {
    World world = test::two_disks(0.4, {1.3, 0.2}, {-0.4, 0.5});
    world.grains.omega = {10.0, 20.0};
    const double slip = relative(world.grains, 0.4).tangential;
    hit(world, settings_with(0.5, et, 100.0));
    EXPECT_NEAR(relative(world.grains, 0.4).tangential, -et * slip, 1e-13);
  }
}

// At a sliding contact, |P_t| = mu P_n against the slip, with P_n = (1 + e) m |U_n|.
TEST_P(Impact, friction_is_bounded_by_coulomb) {
  const double e = 0.5;
  const double friction = 0.1;
  for (double side : {1.0, -1.0}) {
    World world = test::two_disks(0.0, {1.0, side}, {-1.0, -side});
    const Grains& g = world.grains;
    const double mass = g.mass[0] * g.mass[1] / (g.mass[0] + g.mass[1]);
    hit(world, settings_with(e, 0.0, friction));
    const double pn = world.contacts.fn[0] * test::time_step;
    const double pt = world.contacts.ft[0] * test::time_step;
    EXPECT_NEAR(pn, (1.0 + e) * mass * 2.0, 1e-13);
    EXPECT_NEAR(pt, friction * pn * side, 1e-14);  // b slips along -side and is pushed back
    EXPECT_GT(-side * relative(g, 0.0).tangential, 0.0);
  }
}

// gap+/h rule: a plastic impact across a gap ends with the disks in contact at the next midpoint.
TEST_P(Impact, a_plastic_impact_closes_the_gap_first) {
  World world = test::disk_on_plane(0.0);
  world.gravity = 0.0;
  world.grains.vy[0] = -1.0;
  const double gap = 0.3 * test::time_step;
  world.grains.y[0] += 0.5 * test::time_step + gap;
  const StepSettings settings = settings_with(0.0, 0.0, 0.5);
  StepWorkspace workspace;
  step(world, settings, workspace);
  EXPECT_NEAR(world.grains.vy[0], -gap / test::time_step, 1e-13);
  step(world, settings, workspace);
  EXPECT_NEAR(world.contacts.gap[0], 0.0, 1e-16);
  EXPECT_NEAR(world.grains.vy[0], 0.0, 1e-13);
}

}  // namespace
}  // namespace talus::dynamics
