/// Energy balance of the scheme. With P the impulses of a step, v- + h g the free velocity and e = 0,
/// Signorini and Coulomb give K(v+) - K(v- + h g) = P . U+ - P . W P / 2 <= 0. Because positions follow (v- +
/// v+) / 2, potential energy takes exactly the work of gravity, and the total energy increases by at most - w
/// . M w / 2 - (h / 2) w . M g, with w = M^-1 H P: never more than m (g h)^2 / 8 per grain and step, and not
/// at all without gravity.

#include <gtest/gtest.h>

#include <algorithm>

#include "dynamics/collapse.h"
#include "support/scenes.h"

namespace talus {
namespace {

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

class Energy : public testing::TestWithParam<bool> {};

INSTANTIATE_TEST_SUITE_P(Beds, Energy, testing::Values(true, false),
                         [](const auto& parameter) { return parameter.param ? "periodic" : "walled"; });

TEST_P(Energy, never_grows_while_a_bed_falls_and_comes_to_rest) {
  const dynamics::StepSettings settings = test::bed_step(1e-8);
  World world = dynamics::make_loose_bed(test::bed_plan(GetParam(), 120, 12, 3), 0.4);
  world.tilt = 0.1;
  const double start = test::mechanical_energy(world);
  const double quantum = test::weight(world) * world.gravity * settings.h * settings.h / 8.0;
  const double solver_error = 1e-9 * test::weight(world) * dynamics::BedPlan{}.mean_diameter;
  dynamics::StepWorkspace workspace;
  double energy = start, largest_gain = 0.0;
  for (int k = 0; k < 500; ++k) {
    const double before = free_energy(world, settings.h);
    dynamics::step(world, settings, workspace);
    EXPECT_LE(kinetic_energy(world.grains), before + solver_error) << k;
    const double now = test::mechanical_energy(world);
    largest_gain = std::max(largest_gain, now - energy);
    EXPECT_LE(now, energy + quantum + solver_error) << k;
    EXPECT_LE(now, start + solver_error) << k;
    energy = now;
  }
  EXPECT_LT(energy, start - 0.2 * test::weight(world) * dynamics::BedPlan{}.mean_diameter) << "nothing fell";
  RecordProperty("largest_gain_over_quantum", std::to_string(largest_gain / quantum));
}

TEST_P(Energy, never_grows_with_restitution) {
  dynamics::StepSettings settings = test::bed_step(1e-8);
  settings.law.restitution = 0.5;
  World world = dynamics::make_loose_bed(test::bed_plan(GetParam(), 120, 12, 4), 0.4);
  const double start = test::mechanical_energy(world);
  const double quantum = test::weight(world) * world.gravity * settings.h * settings.h / 8.0;
  dynamics::StepWorkspace workspace;
  double energy = start, largest_gain = 0.0;
  for (int k = 0; k < 400; ++k) {
    dynamics::step(world, settings, workspace);
    const double now = test::mechanical_energy(world);
    largest_gain = std::max(largest_gain, now - energy);
    EXPECT_LE(now, energy + quantum) << k;
    energy = now;
  }
  EXPECT_LT(energy, start - 0.2 * test::weight(world) * dynamics::BedPlan{}.mean_diameter) << "nothing fell";
  RecordProperty("largest_gain_over_quantum", std::to_string(largest_gain / quantum));
}

}  // namespace
}  // namespace talus
