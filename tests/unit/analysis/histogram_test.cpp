/// Histograms, cells of points, and power laws.

#include "analysis/histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/cells.h"
#include "analysis/events/events.h"
#include "core/random.h"

namespace talus::analysis {
namespace {

TEST(Histogram, counts_between_its_edges) {
  Histogram histogram(0.0, 1.0, 4);
  for (double value : {0.0, 0.25, 0.3, 0.49, 0.5, 1.0}) histogram.add(value);
  EXPECT_EQ(histogram.weight, (std::vector<double>{1.0, 3.0, 1.0, 1.0}));
  EXPECT_EQ(histogram.outside, 0.0);
  EXPECT_EQ(histogram.centre(1), 0.375);
  for (double value : {-0.1, 1.1, std::nan("")}) histogram.add(value);
  EXPECT_EQ(histogram.outside, 2.0);
  EXPECT_EQ(histogram.total, 8.0);
}

TEST(Histogram, density_has_the_integral_one) {
  Histogram histogram(logarithmic_edges(0.01, 10.0, 6));
  EXPECT_NEAR(histogram.edges[2], 0.1, 1e-12);
  EXPECT_EQ(histogram.edges.back(), 10.0);
  for (int k = 1; k < 10; ++k) histogram.add(k, 0.5);
  double integral = 0.0;
  for (std::size_t bin = 0; bin < 6; ++bin) integral += histogram.density()[bin] * histogram.width(bin);
  EXPECT_NEAR(integral, 1.0, 1e-12);
  histogram.add(20.0, 4.5);
  integral = 0.0;
  for (std::size_t bin = 0; bin < 6; ++bin) integral += histogram.density()[bin] * histogram.width(bin);
  EXPECT_NEAR(integral, 0.5, 1e-12);
}

TEST(Histogram, error_is_that_of_counting) {
  Histogram histogram(0.0, 2.0, 2);
  for (int k = 0; k < 9; ++k) histogram.add(0.5, 2.0);
  for (int k = 0; k < 16; ++k) histogram.add(1.5, 2.0);
  EXPECT_NEAR(histogram.error()[0], histogram.density()[0] / 3.0, 1e-15);
  EXPECT_NEAR(histogram.error()[1], histogram.density()[1] / 4.0, 1e-15);
}

TEST(Histogram, of_nothing_is_zero) {
  const Histogram histogram(0.0, 1.0, 2);
  EXPECT_EQ(histogram.density(), (std::vector<double>{0.0, 0.0}));
  EXPECT_EQ(histogram.error(), (std::vector<double>{0.0, 0.0}));
}

struct Places {
  std::vector<double> x, y;
};

Places random_places(int count) {
  Random random(21);
  Places places;
  for (int k = 0; k < count; ++k) {
    places.x.push_back(random.uniform(0.0, 20.5));
    places.y.push_back(random.uniform(-3.0, 7.0));
  }
  return places;
}

TEST(Cells, rings_meet_each_point_once_and_the_near_ones_first) {
  const Places places = random_places(100);
  for (const double period : {0.0, 20.5})
    for (const double size : {1.0, 3.0, 30.0}) {
      const Cells cells = sort_into_cells(places.x, places.y, size, period);
      for (std::size_t i = 0; i < 100; ++i) {
        std::vector<Index> met;
        bool more = true;
        for (Index ring = 0; more; ++ring) {
          const auto record = [&](Index j) {
            met.push_back(j);
            double dx = places.x[j] - places.x[i];
            dx += nearest_image(dx, period) * period;
            // A grain left for this ring is farther away than the previous rings.
            EXPECT_GE(std::hypot(dx, places.y[j] - places.y[i]), std::max(0, ring - 1) * cells.size);
          };
          more = visit_ring(cells, column_of(cells, places.x[i]), row_of(cells, places.y[i]), ring, record);
        }
        std::sort(met.begin(), met.end());
        ASSERT_EQ(met.size(), 100u);
        EXPECT_TRUE(std::adjacent_find(met.begin(), met.end()) == met.end());
      }
    }
}

TEST(Cells, of_a_point_far_away_are_not_many) {
  Places places = random_places(100);
  places.y[50] = 1e5;
  EXPECT_LT(sort_into_cells(places.x, places.y, 1.0, 20.5).start.size(), 1000u);
}

TEST(Cells, of_nothing) {
  const Cells cells = sort_into_cells({}, {}, 1.0, 0.0);
  visit_ring(cells, 0, 0, 0, [](Index) { FAIL(); });
}

TEST(NearestImage, is_at_most_half_a_period_away) {
  EXPECT_EQ(nearest_image(4.0, 10.0), 0);
  EXPECT_EQ(nearest_image(6.0, 10.0), -1);
  EXPECT_EQ(nearest_image(-6.0, 10.0), 1);
  EXPECT_EQ(nearest_image(6.0, 0.0), 0);
  EXPECT_EQ(nearest_image(-6.0, 0.0), 0);
}

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
