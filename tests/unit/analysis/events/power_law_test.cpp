/// Maximum-likelihood exponents of samples with a known law.

#include "analysis/events/power_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/random.h"

namespace talus::analysis {
namespace {

/// Samples x = minimum (1 - u)^(-1 / (alpha - 1)), the inverse of the cumulative distribution.
std::vector<double> power_sample(double alpha, double minimum, int count, Random random) {
  std::vector<double> sample;
  for (int k = 0; k < count; ++k)
    sample.push_back(minimum * std::pow(1.0 - random.uniform(), -1.0 / (alpha - 1.0)));
  return sample;
}

TEST(PowerLaw, finds_the_exponent_of_a_sample_within_its_error) {
  for (const double alpha : {1.5, 2.5}) {
    const PowerLaw law = power_law_from(power_sample(alpha, 0.01, 4000, Random(7)), 0.01);
    EXPECT_EQ(law.count, 4000);
    EXPECT_NEAR(law.error, (alpha - 1.0) / std::sqrt(4000.0), 0.05 * law.error);
    EXPECT_NEAR(law.exponent, alpha, 3.0 * law.error);
    EXPECT_LT(law.distance, 0.03);
  }
}

TEST(PowerLaw, of_a_few_values_is_what_the_formula_says) {
  const std::vector<double> values = {1, 2, 4, 8, 16, 32, 64, 128, 256, 512};
  const PowerLaw law = power_law_from(values, 1.0);
  EXPECT_NEAR(law.exponent, 1.0 + 10.0 / (45.0 * std::log(2.0)), 1e-12);
  EXPECT_NEAR(law.error, (law.exponent - 1.0) / std::sqrt(10.0), 1e-12);
  EXPECT_NEAR(law.share_from(4.0), std::pow(4.0, 1.0 - law.exponent), 1e-12);
  // The law exceeds the sample at its lower end: all values are at least the first, and nine exceed it.
  EXPECT_GT(law.distance, 0.0);
  EXPECT_EQ(power_law_from(values, 3.0).count, 8);
}

TEST(PowerLaw, begins_where_a_sample_begins_to_follow_it) {
  // Below 1 the sample is uniform, like small events that are only partly detected.
  std::vector<double> sample = power_sample(2.0, 1.0, 700, Random(3));
  Random random(4);
  for (int k = 0; k < 500; ++k) sample.push_back(random.uniform(0.0, 1.0));
  const PowerLaw law = power_law(sample);
  EXPECT_GT(law.minimum, 0.8);
  EXPECT_LT(law.minimum, 1.6);
  EXPECT_NEAR(law.exponent, 2.0, 3.0 * law.error);
  EXPECT_GT(std::fabs(power_law_from(sample, 0.05).exponent - 2.0), 0.3)
      << "the entire sample does not follow a power law";
}

TEST(PowerLaw, of_too_few_values_is_not_known) {
  const std::vector<double> values = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  for (const PowerLaw& law : {power_law(values), power_law_from(values, 1.0)}) {
    EXPECT_TRUE(std::isnan(law.exponent));
    EXPECT_TRUE(std::isnan(law.error));
    EXPECT_EQ(law.count, 9);
  }
  EXPECT_TRUE(std::isnan(power_law(std::vector<double>(20, 1.0)).exponent)) << "all are equal";
  EXPECT_EQ(power_law({}).count, 0);
}

TEST(PowerLaw, takes_no_values_that_are_none) {
  std::vector<double> values = power_sample(2.0, 1.0, 50, Random(1));
  const PowerLaw law = power_law(values);
  values.insert(values.end(), {not_known, -3.0, 0.0});
  EXPECT_EQ(power_law(values).exponent, law.exponent);
}

TEST(ExponentialLaw, finds_the_mean_of_a_sample_beyond_its_shortest) {
  Random random(11);
  std::vector<double> waits = {not_known};
  for (int k = 0; k < 4000; ++k) waits.push_back(0.1 - 0.5 * std::log(1.0 - random.uniform()));
  const ExponentialLaw law = exponential_law(waits, 0.1);
  EXPECT_EQ(law.count, 4000);
  EXPECT_NEAR(law.mean, 0.5, 3.0 * law.error);
  EXPECT_NEAR(law.error, 0.5 / std::sqrt(4000.0), 0.001);
  EXPECT_TRUE(std::isnan(exponential_law(std::vector<double>(9, 1.0), 0.1).mean));
}

}  // namespace
}  // namespace talus::analysis
