/// Contact forces stored in one byte.

#include "exports/page/contact_tables.h"

#include <gtest/gtest.h>

#include <cmath>

namespace talus::exports {
namespace {

TEST(ForceCode, is_within_two_percent_of_the_mean_force) {
  for (double force = 0.0; force < 6.0; force += 0.0037) {
    const double back = force_of(force_code(force));
    EXPECT_NEAR(std::sqrt(back), std::sqrt(force), 0.5 * std::sqrt(6.0) / 254.0 + 1e-9) << force;
    if (force > 0.5) {
      EXPECT_NEAR(back / force, 1.0, 0.02) << force;
    }
  }
}

TEST(ForceCode, of_a_contact_is_never_that_of_none) {
  EXPECT_EQ(force_code(0.0), 1U);
  EXPECT_EQ(force_code(1e-9), 1U);
  EXPECT_EQ(force_code(6.0), 255U);
  EXPECT_EQ(force_code(60.0), 255U) << "the width of lines is limited";
}

}  // namespace
}  // namespace talus::exports
