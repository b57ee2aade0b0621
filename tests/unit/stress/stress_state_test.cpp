#include "stress/stress_state.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/trigonometry.h"
#include "stress/overload.h"

namespace talus::stress {
namespace {

/// Returns a tensor with principal values s1, s2 and the major direction at `angle` to x.
Tensor2 tensor_of(double s1, double s2, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {s1 * c * c + s2 * s * s, (s1 - s2) * c * s, (s1 - s2) * c * s, s1 * s * s + s2 * c * c};
}

TEST(StressState, has_the_principal_values_and_the_direction) {
  for (double angle : {-1.5, -0.7, 0.0, 0.4, 1.2, 1.57}) {
    const StressState state = stress_state(tensor_of(5.0, 3.0, angle));
    EXPECT_NEAR(state.mean, 8.0, 1e-14);
    EXPECT_NEAR(state.deviator, 2.0, 1e-14);
    EXPECT_NEAR(state.ratio, 0.25, 1e-14);
    EXPECT_NEAR(state.axis, angle, 1e-14);
  }
}

TEST(StressState, sees_the_symmetric_part_alone) {
  Tensor2 tensor = tensor_of(5.0, 3.0, 0.4);
  tensor.xy += 7.0;
  tensor.yx -= 7.0;
  EXPECT_NEAR(stress_state(tensor).deviator, 2.0, 1e-14);
  EXPECT_NEAR(stress_state(tensor).axis, 0.4, 1e-14);
}

TEST(StressState, the_ratio_is_between_zero_and_one_in_compression) {
  EXPECT_EQ(stress_state({2.0, 0.0, 0.0, 2.0}).ratio, 0.0);
  EXPECT_EQ(stress_state({0.0, 0.0, 0.0, 2.0}).ratio, 1.0);
}

// s1 = 3, s2 = -1, as in a grain under transverse tension (docs/notation.md, gamma).
TEST(StressState, the_ratio_is_above_one_where_one_principal_value_is_a_tension) {
  EXPECT_NEAR(stress_state(tensor_of(3.0, -1.0, 0.4)).ratio, 2.0, 1e-14);
}

TEST(StressState, has_no_ratio_without_compression) {
  EXPECT_TRUE(std::isnan(stress_state({}).ratio));
  EXPECT_TRUE(std::isnan(stress_state({-1.0, 0.0, 0.0, -1.0}).ratio));
  EXPECT_TRUE(std::isnan(stress_state({1.0, 0.0, 0.0, -1.0}).ratio));
}

// s1 = 1 + 0.3, s2 = 1 - 0.3, along the diagonal.
TEST(StressState, of_pure_shear_on_top_of_pressure) {
  const StressState state = stress_state({1.0, 0.3, 0.3, 1.0});
  EXPECT_NEAR(state.ratio, 0.3, 1e-15);
  EXPECT_NEAR(state.axis, 0.25 * pi, 1e-15);
}

TEST(Overload, begins_at_the_threshold_and_leaves_out_grains_that_carry_nothing) {
  EXPECT_TRUE(is_overloaded(0.35, 0.35));
  EXPECT_TRUE(is_overloaded(0.36, 0.35));
  EXPECT_FALSE(is_overloaded(0.34, 0.35));
  EXPECT_FALSE(is_overloaded(std::numeric_limits<double>::quiet_NaN(), 0.35));
}

}  // namespace
}  // namespace talus::stress
