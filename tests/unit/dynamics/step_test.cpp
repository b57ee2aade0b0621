#include "dynamics/step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "base/errors.h"
#include "dynamics/bed.h"
#include "support/exit_code.h"
#include "support/scenes.h"

namespace talus::dynamics {
namespace {

BedPlan falling_plan(bool periodic) { return test::bed_plan(periodic, 36, 8, 11); }

TEST(Step, a_copied_world_goes_on_with_the_same_bits) {
  for (const bool periodic : {true, false}) {
    const StepSettings settings = test::bed_step(1e-6);
    World world = make_loose_bed(falling_plan(periodic), 0.4);
    StepWorkspace workspace;
    for (int k = 0; k < 120; ++k) step(world, settings, workspace);
    World copy = world;
    StepWorkspace fresh;
    for (int k = 0; k < 50; ++k) {
      world.tilt = copy.tilt = 1e-4 * k;
      const StepReport report = step(world, settings, workspace);
      const StepReport again = step(copy, settings, fresh);
      ASSERT_EQ(state_hash(copy), state_hash(world)) << k;
      EXPECT_EQ(again.solver.iterations, report.solver.iterations);
      EXPECT_EQ(again.largest_overlap, report.largest_overlap);
      EXPECT_EQ(copy.contacts.gap, world.contacts.gap);
    }
  }
}

// Gaps up to `margin`, which doubles until it exceeds the distance that velocities can close in a step, 2 h
// (v + g h).
TEST(Step, lists_pairs_up_to_a_gap_that_changes_by_doubling) {
  StepSettings settings = test::bed_step(1e-8);
  const auto listed = [&settings](double gap, double velocity) {
    World world;
    world.gravity = 0.0;
    world.boundary.length = 100.0 * test::radius;
    for (const double x : {1.0, 2.0})
      add_disk(world.grains, {x * (2.0 * test::radius) + (x > 1.0 ? gap : 0.0), 1.0}, test::radius,
               test::density, false);
    add_disk(world.grains, {80.0 * test::radius, 1.0}, test::radius, test::density, false);
    world.grains.vy[2] = velocity;
    StepWorkspace workspace;
    begin_step(world, settings, workspace);
    return workspace.contacts.count() == 1;
  };
  const double margin = settings.margin, per_margin = margin / (2.0 * settings.h);
  const auto expect_margin = [&](double times, double velocity) {
    EXPECT_TRUE(listed((times - 1e-6) * margin, velocity)) << times << ' ' << velocity;
    EXPECT_FALSE(listed((times + 1e-6) * margin, velocity)) << times << ' ' << velocity;
  };
  expect_margin(1.0, 0.0);
  expect_margin(2.0, 0.5 * per_margin);
  expect_margin(2.0, (1.0 - 1e-9) * per_margin);
  expect_margin(4.0, (1.0 + 1e-9) * per_margin);
  expect_margin(8.0, 4.5 * per_margin);
  settings.margin = 0.0;
  EXPECT_TRUE(listed(0.99 * margin, per_margin))
      << "a zero margin cannot double; the gap follows from the velocities";
  EXPECT_FALSE(listed(1.01 * margin, per_margin));
}

TEST(Step, counts_steps_and_time_and_reports_what_it_did) {
  const StepSettings settings = test::bed_step(1e-8);
  World world = test::fallen_bed(falling_plan(true), settings, 100);
  EXPECT_EQ(world.step, 100);
  EXPECT_NEAR(world.time, 0.1, 1e-15);
  StepWorkspace workspace;
  const StepReport report = step(world, settings, workspace);
  EXPECT_EQ(world.step, 101);
  EXPECT_EQ(report.contacts, world.contacts.count());
  EXPECT_EQ(report.motion.rms_velocity, rms_velocity(world.grains));
  EXPECT_EQ(report.motion.kinetic_energy, kinetic_energy(world.grains));
  double fastest = 0.0, mass = 0.0;
  for (Index i = 0; i < world.grains.free_count; ++i) {
    fastest = std::max(fastest, std::hypot(world.grains.vx[i], world.grains.vy[i]));
    mass += world.grains.mass[i];
  }
  EXPECT_DOUBLE_EQ(report.motion.largest_velocity, fastest);
  EXPECT_EQ(report.motion.mass, mass);
  double overlap = 0.0;
  for (double gap : world.contacts.gap) overlap = std::max(overlap, -gap);
  EXPECT_EQ(report.largest_overlap, overlap);
  EXPECT_TRUE(report.solver.converged);
  EXPECT_LE(report.solver.residual.eta, 1e-8 * (1.0 + 1e-9));
  for (double seconds : report.seconds) EXPECT_GE(seconds, 0.0);
}

TEST(Step, floor_grains_never_move) {
  const BedPlan plan = falling_plan(true);
  const World start = make_loose_bed(plan, 0.4);
  const World world = test::fallen_bed(plan, test::bed_step(), 150);
  for (Index i = start.grains.free_count; i < start.grains.count(); ++i) {
    EXPECT_EQ(world.grains.x[i], start.grains.x[i]);
    EXPECT_EQ(world.grains.y[i], start.grains.y[i]);
    EXPECT_EQ(world.grains.vx[i], 0.0);
    EXPECT_EQ(world.grains.vy[i], 0.0);
    EXPECT_EQ(world.grains.omega[i], 0.0);
    EXPECT_EQ(world.grains.angle[i], 0.0);
  }
}

// A world that cannot be computed is rejected and stays unchanged.
TEST(Step, a_velocity_that_is_not_finite_is_an_error_that_leaves_the_world_alone) {
  World world = test::fallen_bed(falling_plan(true), test::bed_step(), 50);
  world.gravity = std::numeric_limits<double>::infinity();
  const World before = world;
  StepWorkspace workspace;
  EXPECT_EQ(test::refusal_of([&] { step(world, test::bed_step(), workspace); }),
            (test::Refusal{ExitCode::internal, "step 51: a velocity is not finite"}));
  EXPECT_EQ(state_hash(world), state_hash(before));
}

TEST(Step, an_empty_world_only_ages) {
  World world;
  StepWorkspace workspace;
  const StepReport report = step(world, test::bed_step(), workspace);
  EXPECT_EQ(world.step, 1);
  EXPECT_TRUE(report.solver.converged);
  EXPECT_EQ(report.contacts, 0);
}

}  // namespace
}  // namespace talus::dynamics
