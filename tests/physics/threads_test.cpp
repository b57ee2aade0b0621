#include <gtest/gtest.h>

#include "support/scenes.h"

namespace talus {
namespace {

// Large enough that three threads have work: a solver may leave threads idle on small problems.
TEST(Threads, any_number_of_them_gives_the_same_bits) {
  StepSettings settings = test::bed_step(1e-4);
  const World start = test::fallen_bed(test::bed_plan(true, 3000, 60, 5), settings, 160);
  ASSERT_GT(start.contacts.count(), 3200);
  settings.solver.max_iterations = 100;
  World alone = start;
  StepWorkspace workspace;
  for (int k = 0; k < 5; ++k) step(alone, settings, workspace);
  for (int threads : {2, 3}) {
    settings.solver.threads = threads;
    World together = start;
    StepWorkspace fresh;
    for (int k = 0; k < 5; ++k) step(together, settings, fresh);
    EXPECT_EQ(state_hash(together), state_hash(alone)) << threads << " threads";
  }
}

}  // namespace
}  // namespace talus
