/// One disk on an incline, in the discrete form of the law. The acceleration is constant, so v_k = k h a, and
/// the two half moves of a step form the trapezoidal rule, x_k = x_0 + a (k h)^2 / 2. The disk touches the
/// plane from the first midpoint on, so both hold to round-off.

#include <gtest/gtest.h>

#include <cmath>

#include "core/trigonometry.h"
#include "support/scenes.h"

namespace talus::dynamics {
namespace {

using test::radius;
using test::time_step;

constexpr double friction = 0.5;
constexpr int steps = 100;

class Incline : public testing::TestWithParam<solver::SolverKind> {
 protected:
  World after_steps(double tilt, bool rotates, double rolling_friction = 0.0) {
    World world = test::disk_on_plane(tilt);
    if (!rotates) world.grains.inverse_inertia[0] = 0.0;
    StepSettings settings = test::exact_step(GetParam(), friction);
    settings.law.rolling_friction = rolling_friction;
    StepWorkspace workspace;
    for (int k = 0; k < steps; ++k) step(world, settings, workspace);
    return world;
  }

  void expect_motion(const World& world, double acceleration, double angular_acceleration) {
    const double t = steps * time_step;
    const double scale = world.gravity * t;
    EXPECT_NEAR(world.grains.vx[0], acceleration * t, 1e-12 * scale);
    EXPECT_NEAR(world.grains.vy[0], 0.0, 1e-12 * scale);
    EXPECT_NEAR(radius * world.grains.omega[0], radius * angular_acceleration * t, 1e-12 * scale);
    EXPECT_NEAR(world.grains.x[0] - 0.1, 0.5 * acceleration * t * t, 1e-12 * scale * t);
    EXPECT_NEAR(radius * world.grains.angle[0], 0.5 * radius * angular_acceleration * t * t,
                1e-12 * scale * t);
    EXPECT_NEAR(world.grains.y[0], radius, 1e-15);
  }

  /// Checks the force of the disk on the plane: the normal points into the plane, so f_n carries the weight;
  /// the tangent (1, 0) points along the plane, so f_t is the friction on the plane, downslope.
  void expect_forces(const World& world, double fn, double ft) {
    ASSERT_EQ(world.contacts.count(), 1);
    const double scale = test::weight(world);
    EXPECT_NEAR(world.contacts.fn[0], fn, 1e-11 * scale);
    EXPECT_NEAR(world.contacts.ft[0], ft, 1e-11 * scale);
  }
};

INSTANTIATE_TEST_SUITE_P(Solvers, Incline, testing::ValuesIn(test::both_solvers),
                         [](const auto& parameter) { return test::name_of(parameter.param); });

TEST_P(Incline, a_disk_that_may_not_rotate_sticks_up_to_the_angle_of_friction) {
  for (double share : {0.0, 0.5, 0.999}) {
    const double tilt = std::atan(share * friction);
    const World world = after_steps(tilt, false);
    expect_motion(world, 0.0, 0.0);
    expect_forces(world, test::weight(world) * cosine(tilt), test::weight(world) * sine(tilt));
  }
}

TEST_P(Incline, a_disk_that_may_not_rotate_slides_beyond_it) {
  for (double share : {1.001, 1.5, 4.0}) {
    const double tilt = std::atan(share * friction);
    const World world = after_steps(tilt, false);
    expect_motion(world, world.gravity * (sine(tilt) - friction * cosine(tilt)), 0.0);
    const double fn = test::weight(world) * cosine(tilt);
    expect_forces(world, fn, friction * fn);
  }
}

TEST_P(Incline, friction_opposes_the_motion_on_either_slope) {
  const double tilt = -std::atan(2.0 * friction);
  const World world = after_steps(tilt, false);
  expect_motion(world, world.gravity * (sine(tilt) + friction * cosine(tilt)), 0.0);
}

// Rolling: m a = m g sin - F, I alpha = F r, a = alpha r with I = m r^2 / 2 give F = m g sin / 3.
TEST_P(Incline, a_free_disk_rolls_up_to_three_times_the_friction) {
  for (double share : {0.1, 1.0, 2.0, 2.997}) {
    const double tilt = std::atan(share * friction);
    const World world = after_steps(tilt, true);
    const double acceleration = 2.0 / 3.0 * world.gravity * sine(tilt);
    expect_motion(world, acceleration, -acceleration / radius);
    expect_forces(world, test::weight(world) * cosine(tilt), test::weight(world) * sine(tilt) / 3.0);
  }
}

TEST_P(Incline, a_free_disk_slides_and_turns_beyond_it) {
  for (double share : {3.003, 4.0, 10.0}) {
    const double tilt = std::atan(share * friction);
    const World world = after_steps(tilt, true);
    expect_motion(world, world.gravity * (sine(tilt) - friction * cosine(tilt)),
                  -2.0 * friction * world.gravity * cosine(tilt) / radius);
  }
}

// On a plane l = r. Without sliding the disk stays at rest if r F = m g r sin is at most mu_r r f_n; the
// moment on the plane is clockwise, and that on the disk opposes rolling.
TEST_P(Incline, a_disk_that_resists_rolling_stays_up_to_the_angle_of_rolling_friction) {
  constexpr double rolling_friction = 0.3;
  for (double share : {0.0, 0.5, 0.999}) {
    const double tilt = std::atan(share * rolling_friction);
    const World world = after_steps(tilt, true, rolling_friction);
    expect_motion(world, 0.0, 0.0);
    expect_forces(world, test::weight(world) * cosine(tilt), test::weight(world) * sine(tilt));
    ASSERT_EQ(world.contacts.moment.size(), 1u);
    EXPECT_NEAR(world.contacts.moment[0], -radius * test::weight(world) * sine(tilt),
                1e-11 * radius * test::weight(world));
  }
}

// Rolling: m a = m g sin - F, I alpha = F r - mu_r r m g cos, a = alpha r give a = 2/3 g (sin - mu_r cos) and
// F = m g (sin + 2 mu_r cos) / 3.
TEST_P(Incline, a_disk_that_resists_rolling_rolls_beyond_it) {
  constexpr double rolling_friction = 0.2;
  for (double share : {1.001, 2.0, 4.0}) {
    const double tilt = std::atan(share * rolling_friction);
    const World world = after_steps(tilt, true, rolling_friction);
    const double acceleration = 2.0 / 3.0 * world.gravity * (sine(tilt) - rolling_friction * cosine(tilt));
    expect_motion(world, acceleration, -acceleration / radius);
    const double fn = test::weight(world) * cosine(tilt);
    expect_forces(world, fn, test::weight(world) * sine(tilt) / 3.0 + 2.0 / 3.0 * rolling_friction * fn);
    EXPECT_NEAR(world.contacts.moment[0], -rolling_friction * radius * fn, 1e-11 * radius * fn);
  }
}

// If mu_r >= mu the disk slides before it rolls, and does not turn while the moment can hold it.
TEST_P(Incline, a_disk_that_resists_rolling_more_than_sliding_slides_without_turning) {
  const double tilt = std::atan(1.5 * friction);
  const World world = after_steps(tilt, true, 2.0 * friction);
  expect_motion(world, world.gravity * (sine(tilt) - friction * cosine(tilt)), 0.0);
}

// Without contact, v and x follow free fall by the same trapezoidal rule.
TEST_P(Incline, a_disk_above_the_plane_falls_freely) {
  World world = test::disk_on_plane(radians(20.0));
  world.grains.y[0] = 1.0;
  const StepSettings settings = test::exact_step(GetParam());
  StepWorkspace workspace;
  for (int k = 0; k < steps; ++k) step(world, settings, workspace);
  const double t = steps * time_step;
  const Vec2 g = gravity_vector(world);
  EXPECT_EQ(world.contacts.count(), 0);
  EXPECT_NEAR(world.grains.vx[0], g.x * t, 1e-14);
  EXPECT_NEAR(world.grains.vy[0], g.y * t, 1e-14);
  EXPECT_NEAR(world.grains.x[0], 0.1 + 0.5 * g.x * t * t, 1e-15);
  EXPECT_NEAR(world.grains.y[0], 1.0 + 0.5 * g.y * t * t, 1e-14);
}

}  // namespace
}  // namespace talus::dynamics
