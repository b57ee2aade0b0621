/// Events across the periodic edge proceed as in the middle of the bed.

#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/bed.h"
#include "support/scenes.h"

namespace talus::dynamics {
namespace {

using test::radius;

class PeriodicEdge : public testing::TestWithParam<solver::SolverKind> {};

INSTANTIATE_TEST_SUITE_P(Solvers, PeriodicEdge, testing::ValuesIn(test::both_solvers),
                         [](const auto& parameter) { return test::name_of(parameter.param); });

/// Returns an impact of two disks, moved to the neighbourhood of x in a bed of period 1.
World impact_around(double x) {
  World world = test::two_disks(0.3, {1.0, 0.2}, {-0.7, 0.1});
  world.boundary.periodic = true;
  for (double& centre : world.grains.x) {
    centre += x - 0.5;
    centre -= std::floor(centre);
  }
  return world;
}

TEST_P(PeriodicEdge, an_impact_across_it_conserves_momentum_and_is_as_in_the_middle) {
  const StepSettings settings = test::exact_step(GetParam());
  World middle = impact_around(0.5);
  World edge = impact_around(-0.2 * radius);
  ASSERT_GT(edge.grains.x[0], edge.grains.x[1]);
  const test::Momentum before = test::momentum(edge.grains);
  StepWorkspace workspace;
  step(middle, settings, workspace);
  step(edge, settings, workspace);
  ASSERT_EQ(edge.contacts.count(), 1);
  EXPECT_EQ(edge.contacts.shift[0], 1);
  EXPECT_GT(edge.contacts.fn[0], 0.0);
  const test::Momentum after = test::momentum(edge.grains);
  EXPECT_NEAR(after.x, before.x, 1e-14);
  EXPECT_NEAR(after.y, before.y, 1e-14);
  for (Index i = 0; i < 2; ++i) {
    EXPECT_NEAR(edge.grains.vx[i], middle.grains.vx[i], 1e-12);
    EXPECT_NEAR(edge.grains.vy[i], middle.grains.vy[i], 1e-12);
    EXPECT_NEAR(edge.grains.omega[i] * radius, middle.grains.omega[i] * radius, 1e-12);
  }
}

// A pair that flies on together: one grain is beyond the edge at the end of a step, but not at its midpoint.
TEST_P(PeriodicEdge, contacts_name_the_image_that_they_are_at_when_the_step_ends) {
  const StepSettings settings = test::exact_step(GetParam());
  World world = impact_around(0.5);
  const double lead = 0.4 * settings.h;  // m, at 1 m/s: crosses in the second half of the step
  const double distance = world.grains.x[1] - world.grains.x[0];
  for (const int direction : {1, -1})
    for (const Index leading : {0, 1}) {
      World pair = world;
      Grains& grains = pair.grains;
      grains.vx = {static_cast<double>(direction), static_cast<double>(direction)};
      grains.vy = {0.0, 0.0};
      const double edge = direction > 0 ? 1.0 : 0.0;
      grains.x[leading] = edge - direction * (0.5 * settings.h + 0.5 * lead);
      grains.x[1 - leading] = grains.x[leading] + (leading == 0 ? distance : -distance);
      grains.x[1 - leading] -= std::floor(grains.x[1 - leading]);
      StepSettings near = settings;
      near.margin = radius;
      StepWorkspace workspace;
      step(pair, near, workspace);
      ASSERT_NE(grains.image[leading], 0) << direction << ' ' << leading;
      ASSERT_EQ(pair.contacts.count(), 1);
      const Index a = pair.contacts.a[0], b = pair.contacts.b[0];
      EXPECT_NEAR(grains.x[b] + pair.contacts.shift[0] - grains.x[a], a == 0 ? distance : -distance, 1e-6)
          << direction << ' ' << leading;
    }
}

TEST_P(PeriodicEdge, a_grain_that_passes_it_comes_in_at_the_other_side) {
  World world;
  world.gravity = 0.0;
  world.boundary.periodic = true;
  world.boundary.length = 1.0;
  add_disk(world.grains, {0.9995, 0.5}, radius, test::density, false);
  add_disk(world.grains, {0.0005, 0.8}, radius, test::density, false);
  world.grains.vx = {1.0, -1.0};
  StepWorkspace workspace;
  for (int k = 0; k < 2500; ++k) step(world, test::exact_step(GetParam()), workspace);
  EXPECT_NEAR(world.grains.x[0], 0.4995, 1e-12);
  EXPECT_NEAR(world.grains.x[1], 0.5005, 1e-12);
  EXPECT_EQ(world.grains.image, (std::vector<Index>{3, -3}));
}

// Grains that fall in a periodic box without a floor: internal forces and gravity perpendicular to x conserve
// the momentum along x, whatever the residual of the solver.
TEST_P(PeriodicEdge, a_falling_crowd_keeps_its_momentum_along_x) {
  BedPlan plan = test::bed_plan(true, 60, 6, 3);
  plan.rough_floor = false;
  World world = make_loose_bed(plan, 0.4);
  world.boundary.planes.clear();
  const World random = test::random_cloud(4, 60, true, 1.0);
  world.grains.vx = random.grains.vx;
  world.grains.vy = random.grains.vy;
  double mass = 0.0;
  for (double m : world.grains.mass) mass += m;
  const test::Momentum before = test::momentum(world.grains);
  StepSettings settings = test::bed_step();
  settings.solver.kind = GetParam();
  settings.solver.max_iterations = 20;
  StepWorkspace workspace;
  Index across = 0;
  for (int k = 0; k < 100; ++k) {
    step(world, settings, workspace);
    for (Index c = 0; c < world.contacts.count(); ++c)
      if (world.contacts.shift[c] != 0 && world.contacts.fn[c] > 0.0) ++across;
  }
  EXPECT_GT(across, 10) << "no disks collided across the edge";
  const test::Momentum after = test::momentum(world.grains);
  EXPECT_NEAR(after.x, before.x, 1e-13 * mass);
  EXPECT_NEAR(after.y, before.y - mass * world.gravity * 100 * test::time_step, 1e-12 * mass);
}

}  // namespace
}  // namespace talus::dynamics
