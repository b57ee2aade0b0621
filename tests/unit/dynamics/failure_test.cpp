#include "dynamics/failure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.h"

namespace talus::dynamics {
namespace {

constexpr double h = 1e-3;
constexpr double diameter = 0.01;
constexpr double gravity = 9.81;
const FlowRule rule =
    flow_rule(diameter, gravity, {.periodic = true, .length = 100 * diameter, .planes = {}});
/// Lowest velocity of a flow, m/s.
const double threshold = rule.velocity;

/// Applies `velocity` for `count` steps of 0.001 rad from `tilt` on; returns the final tilt.
double follow(SurfaceFlow& flow, double velocity, double tilt, int count) {
  for (int k = 0; k < count; ++k, tilt += 1e-3) follow_surface(flow, velocity, tilt, h, rule);
  return tilt;
}

int steps_to_failure(double velocity) { return static_cast<int>(std::ceil(rule.distance / (h * velocity))); }

TEST(Failure, rule_is_the_one_documented) {
  EXPECT_DOUBLE_EQ(rule.velocity, 0.02 * std::sqrt(gravity * diameter));
  EXPECT_DOUBLE_EQ(rule.distance, 5.0 * diameter);
  const auto walled = [](double length) {
    return flow_rule(diameter, gravity, {.periodic = false, .length = length, .planes = {}}).distance;
  };
  EXPECT_DOUBLE_EQ(walled(20.0 * diameter), 1.0 * diameter) << "a flow between close walls ends soon";
  EXPECT_DOUBLE_EQ(walled(300.0 * diameter), 5.0 * diameter);
}

TEST(Failure, a_burst_that_stops_is_forgotten) {
  SurfaceFlow flow;
  const double fast = 10.0 * threshold;
  const double tilt = follow(flow, fast, 0.1, steps_to_failure(fast) - 1);
  EXPECT_TRUE(flow.flowing);
  EXPECT_FALSE(flow.failed);
  follow(flow, 0.0, tilt, 1);
  EXPECT_FALSE(flow.flowing);
  EXPECT_EQ(flow.displacement, 0.0);
  EXPECT_EQ(flow.onset_tilt, 0.0);
  // Displacement before a pause does not count towards the next flow.
  follow(flow, fast, 0.2, steps_to_failure(fast) - 1);
  EXPECT_FALSE(flow.failed);
}

TEST(Failure, a_flow_that_goes_on_gives_the_tilt_of_its_onset) {
  SurfaceFlow flow;
  double tilt = follow(flow, 10.0 * threshold, 0.1, 20);
  tilt = follow(flow, 0.5 * threshold, tilt, 5);
  const double onset = tilt;
  const double fast = 10.0 * threshold;
  tilt = follow(flow, fast, tilt, steps_to_failure(fast) - 1);
  EXPECT_FALSE(flow.failed);
  follow(flow, fast, tilt, 1);
  EXPECT_TRUE(flow.failed);
  EXPECT_EQ(flow.onset_tilt, onset);
  EXPECT_GE(flow.displacement, rule.distance);
}

TEST(Failure, the_velocity_of_the_threshold_is_no_flow_yet) {
  SurfaceFlow flow;
  follow(flow, threshold, 0.1, 5000);
  follow(flow, -10.0 * threshold, 0.1, 1000);
  EXPECT_FALSE(flow.flowing) << "upslope neither";
  follow(flow, threshold * (1.0 + 1e-12), 0.1, 1);
  EXPECT_TRUE(flow.flowing);
}

TEST(Failure, is_final) {
  SurfaceFlow flow;
  const double fast = 10.0 * threshold;
  follow(flow, fast, 0.1, steps_to_failure(fast) + 1);
  ASSERT_TRUE(flow.failed);
  const SurfaceFlow before = flow;
  follow(flow, 0.0, 0.5, 10);
  follow(flow, fast, 0.6, 10);
  EXPECT_TRUE(flow.failed);
  EXPECT_EQ(flow.onset_tilt, before.onset_tilt);
  EXPECT_EQ(flow.displacement, before.displacement);
}

TEST(SurfaceVelocity, is_the_mean_along_x_of_the_free_grains_above) {
  World world = test::column(4);
  add_disk(world.grains, {0.3, 1.0}, test::radius, test::density, true);
  world.grains.vx = {8.0, 4.0, 2.0, 1.0, 100.0};
  EXPECT_DOUBLE_EQ(surface_velocity(world.grains, world.grains.y[1]),
                   1.5);  // only centres above the height count
  EXPECT_DOUBLE_EQ(surface_velocity(world.grains, -1.0), 15.0 / 4.0);
  EXPECT_EQ(surface_velocity(world.grains, 2.0), 0.0);
  EXPECT_EQ(surface_velocity(Grains{}, 0.0), 0.0);
}

}  // namespace
}  // namespace talus::dynamics
