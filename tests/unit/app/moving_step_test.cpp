#include "app/moving_step.h"

#include <gtest/gtest.h>

namespace talus::app {
namespace {

TEST(MovingStep, IsOneOfWhichTheRunAskedLessThanOfABedAtRest) {
  EXPECT_FALSE(is_moving({0.001, 3e-7, 3e-7}));
  EXPECT_TRUE(is_moving({0.23, 2.3e-5, 3e-7}));
}

TEST(MovingStep, IsNamedWithItsTolerances) {
  EXPECT_EQ(remark_on_moving({0.234, 2.34e-5, 3e-7}, 2.1e-5),
            "The bed was moving in this step, at 0.23 g h (rms), so the run required 2.3e-05 instead of the "
            "3.0e-07 of a bed at rest; this solve has reached only the first.");
}

TEST(MovingStep, TellsWhichToleranceWasReached) {
  EXPECT_TRUE(remark_on_moving({0.2, 2e-5, 3e-7}, 2.9e-7).ends_with(" has reached both of them."));
  EXPECT_TRUE(remark_on_moving({0.2, 2e-5, 3e-7}, 2.1e-5).ends_with(" has reached neither of them."));
}

}  // namespace
}  // namespace talus::app
