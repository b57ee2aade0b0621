/// Means over seeds, their errors, and conclusions from them.

#include "core/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/random.h"

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

}  // namespace
}  // namespace talus
