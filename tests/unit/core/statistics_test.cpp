/// Means over seeds, their errors, and conclusions from them.

#include "core/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/random.h"
#include "core/trigonometry.h"

namespace talus {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

TEST(Statistics, are_those_of_hand_made_numbers) {
  const Statistics found = statistics_of(std::vector{1.0, 2.0, 3.0, 6.0});
  EXPECT_EQ(found.count, 4);
  EXPECT_DOUBLE_EQ(found.mean, 3.0);
  EXPECT_DOUBLE_EQ(found.deviation, std::sqrt(14.0 / 3.0)) << "divided by n - 1";
  EXPECT_DOUBLE_EQ(found.error, std::sqrt(14.0 / 3.0 / 4.0));
  EXPECT_DOUBLE_EQ(found.interval(), 3.182 * found.error);
}

TEST(Statistics, leave_out_what_is_no_number) {
  const Statistics found = statistics_of(std::vector{none, 4.0, none, 6.0});
  EXPECT_EQ(found.count, 2);
  EXPECT_DOUBLE_EQ(found.mean, 5.0);
  EXPECT_DOUBLE_EQ(found.error, 1.0);
}

TEST(Statistics, of_one_value_or_none_are_unknown) {
  EXPECT_DOUBLE_EQ(statistics_of(std::vector{4.0}).mean, 4.0);
  EXPECT_TRUE(std::isnan(statistics_of(std::vector{4.0}).error));
  EXPECT_TRUE(std::isnan(statistics_of(std::vector{4.0}).deviation));
  EXPECT_TRUE(std::isnan(statistics_of(std::vector{4.0}).interval()));
  EXPECT_EQ(statistics_of(std::vector{none}).count, 0);
  EXPECT_TRUE(std::isnan(statistics_of(std::vector{none}).mean));
}

TEST(Summary, has_quartiles_between_the_sorted_values) {
  const Summary found = summary_of(std::vector{4.0, 1.0, none, 2.0, 8.0, 3.0});
  EXPECT_DOUBLE_EQ(found.lower_quartile, 2.0);
  EXPECT_DOUBLE_EQ(found.median, 3.0);
  EXPECT_DOUBLE_EQ(found.upper_quartile, 4.0);
  EXPECT_DOUBLE_EQ(summary_of(std::vector{1.0, 2.0, 3.0, 6.0}).upper_quartile, 3.75) << "interpolated";
  EXPECT_DOUBLE_EQ(summary_of(std::vector{7.0}).median, 7.0);
  EXPECT_TRUE(std::isnan(summary_of(std::vector{7.0}).low));
  EXPECT_TRUE(std::isnan(summary_of(std::vector{none}).median));
}

TEST(Summary, has_the_interval_of_students_t) {
  const Summary found = summary_of(std::vector{28.624, none, 31.76});
  EXPECT_NEAR(found.low, 30.192 - 12.7062 * 1.568, 1e-3) << "10.27, far below both values";
  EXPECT_NEAR(found.high, 30.192 + 12.7062 * 1.568, 1e-3);
  const Summary four = summary_of(std::vector{1.0, 2.0, 3.0, 6.0});
  EXPECT_DOUBLE_EQ(four.low, 3.0 - four.statistics.interval());
  EXPECT_DOUBLE_EQ(four.high, 3.0 + four.statistics.interval());
}

/// Returns a nearly normal value with mean 0 and variance 1.
double normal(Random& random) {
  double sum = -6.0;
  for (int k = 0; k < 12; ++k) sum += random.uniform();
  return sum;
}

TEST(Summary, has_an_interval_that_holds_the_mean_of_few_values_as_often_as_it_says) {
  constexpr int samples = 4000;
  for (const std::size_t count : {2u, 3u, 5u, 16u}) {
    Random random(5);
    int holding = 0;
    std::vector<double> values(count);
    for (int k = 0; k < samples; ++k) {
      for (double& value : values) value = normal(random);
      const Summary found = summary_of(values);
      holding += found.low <= 0.0 && 0.0 <= found.high ? 1 : 0;
    }
    EXPECT_NEAR(holding, 0.95 * samples, 0.01 * samples) << count << " values; the deviation is 0.0034";
  }
}

TEST(Correlation, is_that_of_hand_made_pairs) {
  const std::vector<double> x = {1.0, 2.0, 3.0, none, 4.0}, twice = {2.0, 4.0, 6.0, 1.0, 8.0};
  EXPECT_DOUBLE_EQ(correlation_of(x, twice).coefficient, 1.0);
  EXPECT_EQ(correlation_of(x, twice).count, 4);
  const std::vector<double> against = {4.0, 3.0, 2.0, 7.0, 1.0}, other = {1.0, 3.0, 2.0, 0.0, 4.0};
  EXPECT_DOUBLE_EQ(correlation_of(x, against).coefficient, -1.0);
  EXPECT_DOUBLE_EQ(correlation_of(x, other).coefficient, 0.8);
  EXPECT_TRUE(std::isnan(correlation_of(x, std::vector{1.0, 1.0, 1.0, 1.0, 1.0}).coefficient));
  EXPECT_TRUE(std::isnan(correlation_of(std::vector{1.0, 2.0}, std::vector{2.0, 1.0}).coefficient));
}

TEST(StudentT, has_its_known_values) {
  EXPECT_DOUBLE_EQ(student_t(1), 12.706);
  EXPECT_DOUBLE_EQ(student_t(5), 2.571);
  EXPECT_DOUBLE_EQ(student_t(30), 2.042);
  EXPECT_NEAR(student_t(40), 2.02108, 1e-4);
  EXPECT_NEAR(student_t(120), 1.97993, 1e-4);
}

// O'Neill's output for seed 42 and the default stream: pcg-cpp, test-high/expected/check-pcg32_oneseq.out,
// first round: six numbers, then 65 coins (below 2), then 33 rolls of a die (below 6, plus 1).
TEST(Random, gives_the_published_pcg32_sequence) {
  Random random(42);
  for (std::uint32_t expected :
       {0xc2f57bd6u, 0x6b07c4a9u, 0x72b7b29bu, 0x44215383u, 0xf5af5eadu, 0x68beb632u})
    EXPECT_EQ(random.next(), expected);
  std::string coins;
  for (int i = 0; i < 65; ++i) coins += random.below(2) == 1 ? 'H' : 'T';
  EXPECT_EQ(coins, "THTHHHTTHHTTHTTHTHHHTHTTTHTTHTTHTTTHHTTTTTHHTTTHTTHTHHTHHHTTHTTTH");
  std::string rolls;
  for (int i = 0; i < 33; ++i) rolls += std::to_string(random.below(6) + 1);
  EXPECT_EQ(rolls, "413366513443225413331464661612366");
}

// Golden values: pairs of the sequence above in exact arithmetic. If they changed, every published seed would
// give a different bed.
TEST(Random, uniform_keeps_its_golden_sequence) {
  Random random(1);
  for (double expected :
       {0x1.50d4b5fdab08p-2, 0x1.da37531d5582p-6, 0x1.0197514a66cb8p-2, 0x1.f58f2795226c6p-2})
    EXPECT_EQ(random.uniform(), expected);
}

TEST(Random, uniform_stays_in_range_with_the_moments_of_a_uniform_law) {
  constexpr int count = 200'000;
  Random random(7);
  double sum = 0.0, square = 0.0, low = 1.0, high = 0.0;
  for (int i = 0; i < count; ++i) {
    const double u = random.uniform();
    low = std::min(low, u);
    high = std::max(high, u);
    sum += u;
    square += u * u;
  }
  EXPECT_GE(low, 0.0);
  EXPECT_LT(high, 1.0);
  EXPECT_LT(low, 1e-4);
  EXPECT_GT(high, 1.0 - 1e-4);
  const double sigma = std::sqrt(1.0 / 12.0 / count);  // standard deviation of the mean
  EXPECT_NEAR(sum / count, 0.5, 4.0 * sigma);
  EXPECT_NEAR(square / count, 1.0 / 3.0, 4.0 * std::sqrt(4.0 / 45.0 / count));
}

// For a bound of 3/4 of 2^32, a plain remainder would put half of all draws into the lowest third.
TEST(Random, below_is_without_bias_for_a_large_bound) {
  constexpr std::uint32_t third = 1u << 30;
  constexpr int count = 10'000;
  Random random(13);
  int low = 0;
  for (int i = 0; i < count; ++i) low += random.below(3 * third) < third ? 1 : 0;
  EXPECT_NEAR(low, count / 3.0, 4.0 * std::sqrt(count * 2.0 / 9.0));
}

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
