/// Beds whose contacts resist rolling (T38): the laws of friction hold for moments too.

#include <gtest/gtest.h>

#include <algorithm>

#include "dynamics/collapse.h"
#include "support/scenes.h"

namespace talus {
namespace {

dynamics::StepSettings settings_with(double rolling_friction, double tolerance) {
  dynamics::StepSettings settings = test::bed_step(tolerance);
  settings.law.rolling_friction = rolling_friction;
  return settings;
}

/// Returns the kinetic energy of the free grains after free fall over one step.
double free_energy(const World& world, double h) {
  Grains free = world.grains;
  const Vec2 g = gravity_vector(world);
  for (Index i = 0; i < free.free_count; ++i) {
    free.vx[i] += h * g.x;
    free.vy[i] += h * g.y;
  }
  return kinetic_energy(free);
}

// See energy_test.cpp; P_r U_r <= 0 holds too.
TEST(RollingBed, energy_never_grows) {
  const dynamics::StepSettings settings = settings_with(0.2, 1e-8);
  World world = dynamics::make_loose_bed(test::bed_plan(true, 120, 12, 3), 0.4);
  world.tilt = 0.1;
  const double start = test::mechanical_energy(world);
  const double quantum = test::weight(world) * world.gravity * settings.h * settings.h / 8.0;
  const double solver_error = 1e-9 * test::weight(world) * dynamics::BedPlan{}.mean_diameter;
  dynamics::StepWorkspace workspace;
  double energy = start;
  for (int k = 0; k < 400; ++k) {
    const double before = free_energy(world, settings.h);
    dynamics::step(world, settings, workspace);
    EXPECT_LE(kinetic_energy(world.grains), before + solver_error) << k;
    const double now = test::mechanical_energy(world);
    EXPECT_LE(now, energy + quantum + solver_error) << k;
    energy = now;
  }
  EXPECT_LT(energy, start - 0.2 * test::weight(world) * dynamics::BedPlan{}.mean_diameter) << "nothing fell";
}

// At rest each grain is balanced: the torques of the tangential forces equal the moments.
TEST(RollingBed, grains_at_rest_are_in_balance_with_their_moments) {
  const dynamics::StepSettings settings = settings_with(0.2, 1e-9);
  World world = test::settled_bed(test::bed_plan(true, 60, 10, 4), settings);
  const Grains& grains = world.grains;
  const Contacts& contacts = world.contacts;
  ASSERT_EQ(contacts.moment.size(), contacts.a.size());
  std::vector<double> torque(grains.x.size(), 0.0), of_forces(grains.x.size(), 0.0);
  for (Index c = 0; c < contacts.count(); ++c)
    for (const bool second : {false, true}) {
      const Index body = second ? contacts.b[c] : contacts.a[c];
      if (body >= grains.count()) continue;
      of_forces[body] -= grains.radius[body] * contacts.ft[c];
      torque[body] -= grains.radius[body] * contacts.ft[c];
      torque[body] += (second ? 1.0 : -1.0) * contacts.moment[c];
    }
  const double unit = test::weight(world) / grains.free_count * dynamics::BedPlan{}.mean_diameter;
  double largest = 0.0, largest_of_forces = 0.0;
  for (Index i = 0; i < grains.free_count; ++i) {
    largest = std::max(largest, std::abs(torque[i]));
    largest_of_forces = std::max(largest_of_forces, std::abs(of_forces[i]));
  }
  EXPECT_LT(largest, 2e-3 * unit);
  EXPECT_GT(largest_of_forces, 0.05 * unit) << "the moments have no effect";
}

TEST(RollingBed, any_number_of_threads_gives_the_same_bits) {
  dynamics::StepSettings settings = settings_with(0.1, 1e-4);
  settings.solver.max_iterations = 100;
  const World world = test::fallen_bed(test::bed_plan(true, 3000, 60, 5), settings, 160);
  ASSERT_GT(world.contacts.count(), 3200);
  std::uint64_t alone = 0;
  for (const int threads : {1, 2, 4}) {
    settings.solver.threads = threads;
    World together = world;
    dynamics::StepWorkspace workspace;
    for (int k = 0; k < 5; ++k) {
      workspace.solver.accelerated.choice = {};  // all of them, whether or not they pay off
      dynamics::step(together, settings, workspace);
    }
    if (threads == 1)
      alone = state_hash(together);
    else
      EXPECT_EQ(state_hash(together), alone) << threads << " threads";
  }
}

// The moments are part of the state: without them the next step differs, and so does the hash.
TEST(RollingBed, remembers_its_moments) {
  const dynamics::StepSettings settings = settings_with(0.2, 1e-6);
  World world = test::settled_bed(test::bed_plan(true, 60, 10, 4), settings);
  World copy = world, without = world;
  std::ranges::fill(without.contacts.moment, 0.0);
  EXPECT_NE(state_hash(without), state_hash(world));
  dynamics::StepWorkspace first, second, third;
  const int iterations = dynamics::step(world, settings, first).solver.iterations;
  dynamics::step(copy, settings, second);
  const int more = dynamics::step(without, settings, third).solver.iterations;
  EXPECT_EQ(state_hash(copy), state_hash(world));
  EXPECT_LT(iterations, more);
}

}  // namespace
}  // namespace talus
