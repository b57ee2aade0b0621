/// Means over seeds, their errors, and what is concluded from them.

#include "core/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

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

TEST(PairedDifference, does_not_see_what_seeds_have_in_common) {
  const Statistics found = paired_difference(std::vector{11.0, 22.0, 33.0}, std::vector{10.0, 20.0, 30.0});
  EXPECT_EQ(found.count, 3);
  EXPECT_DOUBLE_EQ(found.mean, 2.0);
  EXPECT_DOUBLE_EQ(found.error, 1.0 / std::sqrt(3.0));
}

TEST(PairedDifference, counts_pairs_of_two_numbers_only) {
  const Statistics found =
      paired_difference(std::vector{1.0, none, 3.0, 5.0}, std::vector{0.0, 1.0, none, 2.0});
  EXPECT_EQ(found.count, 2);
  EXPECT_DOUBLE_EQ(found.mean, 2.0);
}

TEST(StudentT, has_its_known_values) {
  EXPECT_DOUBLE_EQ(student_t(1), 12.706);
  EXPECT_DOUBLE_EQ(student_t(5), 2.571);
  EXPECT_DOUBLE_EQ(student_t(30), 2.042);
  EXPECT_NEAR(student_t(40), 2.02108, 1e-4);
  EXPECT_NEAR(student_t(120), 1.97993, 1e-4);
}

TEST(Verdict, goes_by_the_interval_of_95_percent) {
  const auto of = [](int count, double mean, double error) {
    return verdict({count, mean, error * std::sqrt(count), error});
  };
  EXPECT_EQ(of(6, 2.5, 1.0), Verdict::within_error);
  EXPECT_EQ(of(6, -2.6, 1.0), Verdict::differs);
  EXPECT_EQ(of(2, 12.0, 1.0), Verdict::within_error) << "two seeds say little";
  EXPECT_EQ(of(4, 0.0, 0.0), Verdict::within_error) << "the same bits";
  EXPECT_EQ(of(1, 5.0, none), Verdict::unknown);
  EXPECT_EQ(of(0, none, none), Verdict::unknown);
}

}  // namespace
}  // namespace talus
