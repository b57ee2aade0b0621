#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.h"

namespace talus::dynamics {
namespace {

class Statics : public testing::TestWithParam<solver::SolverKind> {};

INSTANTIATE_TEST_SUITE_P(Solvers, Statics, testing::ValuesIn(test::both_solvers),
                         [](const auto& parameter) { return test::name_of(parameter.param); });

// Forces in a column follow from equilibrium: the contact below disk i carries i and all disks above it.
TEST_P(Statics, a_column_carries_the_weight_above_each_contact) {
  const Index count = 10;
  World world = test::column(count);
  StepSettings settings = test::exact_step(GetParam());
  settings.solver.tolerance = 1e-12;
  StepWorkspace workspace;
  for (int k = 0; k < 5; ++k) EXPECT_TRUE(step(world, settings, workspace).solver.converged);
  const double one = test::weight(world) / count;
  ASSERT_EQ(world.contacts.count(), count);
  for (Index c = 0; c < count; ++c) {
    // Sorted by key: disk 0 with disk 1, disk 0 with the plane (the last id), disk 1 with disk 2, ...
    const bool floor = world.contacts.b[c] == count;
    const Index above = floor ? count : count - world.contacts.b[c];
    EXPECT_NEAR(world.contacts.fn[c], above * one, 1e-9 * one) << c;
    EXPECT_NEAR(world.contacts.ft[c], 0.0, 1e-9 * one) << c;
  }
}

// Two disks on the plane carry a third between them: each of its contacts, at 30 degrees to the vertical,
// carries f_n cos 30 + f_t sin 30 = m g / 2; the lower disks rest on the plane with 3/2 m g each.
TEST_P(Statics, three_disks_in_a_heap_balance) {
  World world = test::disk_on_plane(0.0);
  add_disk(world.grains, {0.1 + 2.0 * test::radius, test::radius}, test::radius, test::density, false);
  add_disk(world.grains, {0.1 + test::radius, (1.0 + std::sqrt(3.0)) * test::radius}, test::radius,
           test::density, false);
  StepSettings settings = test::exact_step(GetParam());
  settings.solver.tolerance = 1e-12;
  StepWorkspace workspace;
  for (int k = 0; k < 20; ++k) step(world, settings, workspace);
  const double one = test::weight(world) / 3.0;
  EXPECT_LT(rms_velocity(world.grains), 1e-9 * world.gravity * settings.h);
  int tops = 0, floors = 0;
  for (Index c = 0; c < world.contacts.count(); ++c) {
    const double fn = world.contacts.fn[c];
    if (world.contacts.b[c] == 2) {  // the force on the top disk, from the left (0) or right (1)
      ++tops;
      const double lift = fn * world.contacts.ny[c] + world.contacts.ft[c] * world.contacts.nx[c];
      EXPECT_NEAR(lift, 0.5 * one, 1e-9 * one);
      EXPECT_NEAR(world.contacts.ny[c], std::sqrt(0.75), 1e-9);
    } else if (world.contacts.b[c] == 3) {
      ++floors;
      EXPECT_NEAR(fn, 1.5 * one, 1e-9 * one);
    }
  }
  EXPECT_EQ(tops, 2);
  EXPECT_EQ(floors, 2);
}

}  // namespace
}  // namespace talus::dynamics
