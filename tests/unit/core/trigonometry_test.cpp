#include "core/trigonometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace talus {
namespace {

constexpr int samples = 20'001;

double sample_angle(int i) { return -pi / 2 + pi * i / (samples - 1); }

/// Returns the distance from |value| to the next larger double.
double unit_in_last_place(double value) {
  const double size = std::abs(value);
  return std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
}

TEST(Trigonometry, sine_is_within_two_units_in_the_last_place) {
  for (int i = 0; i < samples; ++i) {
    const double angle = sample_angle(i);
    const double expected = std::sin(angle);
    ASSERT_NEAR(sine(angle), expected, 2.0 * unit_in_last_place(expected)) << "at " << angle;
  }
}

// Near pi/2 the cosine is a small difference of terms of order one, whose rounding unit applies there.
TEST(Trigonometry, cosine_is_within_two_units_in_the_last_place_of_a_half) {
  for (int i = 0; i < samples; ++i) {
    const double angle = sample_angle(i);
    ASSERT_NEAR(cosine(angle), std::cos(angle), 2.0 * unit_in_last_place(0.5)) << "at " << angle;
  }
}

TEST(Trigonometry, arctangent_is_within_six_units_in_the_last_place) {
  for (int i = 1; i < samples - 1; ++i) {
    const double slope = std::tan(sample_angle(i));
    const double expected = std::atan(slope);
    ASSERT_NEAR(arctangent(slope), expected, 6.0 * unit_in_last_place(expected)) << "at " << slope;
  }
  EXPECT_NEAR(arctangent(1e100), pi / 2, 1e-15);
  EXPECT_EQ(arctangent(1e-100), 1e-100);
}

TEST(Trigonometry, has_exact_symmetries_and_values) {
  EXPECT_EQ(sine(0.0), 0.0);
  EXPECT_EQ(cosine(0.0), 1.0);
  EXPECT_EQ(arctangent(0.0), 0.0);
  for (double angle : {0.1, 0.4, 1.5}) {
    EXPECT_EQ(sine(-angle), -sine(angle));
    EXPECT_EQ(cosine(-angle), cosine(angle));
    EXPECT_EQ(arctangent(-angle), -arctangent(angle));
  }
}

// Bits required on every machine, at 20 degrees and at a slope of 0.36.
TEST(Trigonometry, keeps_its_bits) {
  EXPECT_EQ(sine(radians(20.0)), 0x1.5e3a8748a0bf5p-2);
  EXPECT_EQ(cosine(radians(20.0)), 0x1.e11f642522d1cp-1);
  EXPECT_EQ(arctangent(0.36), 0x1.61d9527631ea8p-2);
}

TEST(Trigonometry, radians_and_degrees_are_inverse) {
  EXPECT_DOUBLE_EQ(radians(180.0), pi);
  EXPECT_DOUBLE_EQ(degrees(radians(21.0)), 21.0);
}

}  // namespace
}  // namespace talus
