#include <gtest/gtest.h>

#include <limits>

#include "base/errors.h"
#include "support/scenes.h"

namespace talus {
namespace {

struct FallenBed {
  dynamics::StepSettings settings = test::bed_step(1e-4);
  // Large enough that three threads have work, because a solver may leave threads idle on small problems.
  World world = test::fallen_bed(test::bed_plan(true, 3000, 60, 5), settings, 160);

  explicit FallenBed(double rolling_friction = 0.0) {
    settings.solver.max_iterations = 100;
    settings.law.rolling_friction = rolling_friction;
  }
};

TEST(Threads, any_number_of_them_gives_the_same_bits) {
  for (const double rolling_friction : {0.0, 0.1}) {
    FallenBed bed(rolling_friction);
    ASSERT_GT(bed.world.contacts.count(), 3200);
    World alone = bed.world;
    dynamics::StepWorkspace workspace;
    for (int k = 0; k < 5; ++k) dynamics::step(alone, bed.settings, workspace);
    for (int threads : {2, 3, 4}) {
      bed.settings.solver.threads = threads;
      World together = bed.world;
      dynamics::StepWorkspace fresh;
      for (int k = 0; k < 5; ++k) {
        fresh.solver.accelerated.choice = {};  // all of them, whether or not they pay off
        dynamics::step(together, bed.settings, fresh);
      }
      EXPECT_EQ(state_hash(together), state_hash(alone)) << threads << " threads";
    }
  }
}

TEST(Threads, a_team_whose_step_fails_leaves_the_world_alone) {
  FallenBed bed;
  bed.settings.solver.threads = 2;
  World world = bed.world;
  dynamics::StepWorkspace workspace;
  dynamics::step(world, bed.settings, workspace);
  world.grains.vx[7] = std::numeric_limits<double>::quiet_NaN();
  const World before = world;
  EXPECT_THROW(dynamics::step(world, bed.settings, workspace), Error);
  EXPECT_EQ(state_hash(world), state_hash(before));
}

TEST(Threads, one_that_goes_on_alone_gives_the_same_bits) {
  FallenBed bed;
  World alone = bed.world, left = bed.world;
  dynamics::StepWorkspace workspace, of_team;
  for (int k = 0; k < 4; ++k) dynamics::step(alone, bed.settings, workspace);
  bed.settings.solver.threads = 2;
  solver::TeamChoice& choice = of_team.solver.accelerated.choice;
  for (int k = 0; k < 4; ++k) {
    dynamics::step(left, bed.settings, of_team);
    choice = {};
    if (k == 1) choice.add(1.0, 1.0);  // the team was slow, so one thread is tried
    EXPECT_EQ(choice.in_team(), k != 1);
  }
  EXPECT_EQ(of_team.solver.accelerated.team->size(), 2);
  EXPECT_EQ(state_hash(left), state_hash(alone));
}

}  // namespace
}  // namespace talus
