#include "analysis/packing/pair_correlation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "core/trigonometry.h"
#include "unit/analysis/packings.h"

namespace talus::analysis {
namespace {

using test::Packing;

TEST(PairCorrelation, of_an_alternating_chain) {
  std::vector<double> x, y, value;
  for (int k = 0; k < 20; ++k) {
    x.push_back(k);
    y.push_back(3.0);
    value.push_back(k % 2 == 0 ? 5.0 : 7.0);
  }
  x.push_back(0.5);
  y.push_back(3.0);
  value.push_back(std::nan(""));
  const PairCorrelation result = pair_correlation(x, y, value, 4.5, 9, 20.0);
  // Bins are half a diameter wide: distances 1, 2, 3, 4 are at the beginning of every second bin.
  for (std::size_t bin = 0; bin < 9; ++bin) {
    EXPECT_NEAR(result.r[bin], 0.25 + 0.5 * static_cast<double>(bin), 1e-15);
    if (bin == 0 || bin % 2 == 1) {
      EXPECT_EQ(result.pairs[bin], 0.0);
      EXPECT_TRUE(std::isnan(result.value[bin]));
    } else {
      EXPECT_EQ(result.pairs[bin], 20.0);
      EXPECT_NEAR(result.value[bin], bin % 4 == 0 ? 1.0 : -1.0, 1e-12);
    }
  }
  EXPECT_EQ(pair_correlation(x, y, value, 4.5, 9, 0.0).pairs[2], 19.0);
}

/// Computes the same over all pairs of points.
PairCorrelation plain_correlation(const std::vector<double>& x, const std::vector<double>& y,
                                  const std::vector<double>& value, double largest, int bins, double period) {
  const auto count = static_cast<double>(value.size());
  double mean = 0.0, variance = 0.0;
  for (const double each : value) mean += each / count;
  for (const double each : value) variance += (each - mean) * (each - mean) / count;
  const auto size = static_cast<std::size_t>(bins);
  PairCorrelation plain{{}, std::vector<double>(size, 0.0), std::vector<double>(size, 0.0)};
  for (std::size_t i = 0; i < value.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double dx = period > 0.0 ? std::remainder(x[i] - x[j], period) : x[i] - x[j];
      const double r = std::hypot(dx, y[i] - y[j]);
      if (r >= largest) continue;
      plain.value[static_cast<std::size_t>(r / (largest / bins))] += (value[i] - mean) * (value[j] - mean);
      ++plain.pairs[static_cast<std::size_t>(r / (largest / bins))];
    }
  for (std::size_t bin = 0; bin < size; ++bin) {
    plain.r.push_back((static_cast<double>(bin) + 0.5) * largest / bins);
    plain.value[bin] /= plain.pairs[bin] * variance;  // NaN without pairs
  }
  return plain;
}

TEST(PairCorrelation, equals_the_sum_over_all_pairs) {
  Random random(9);
  for (const bool periodic : {false, true})
    for (const double largest : {0.7, 5.0, 10.0, 40.0})
      for (const double highest : {0.0, 12.0, 1e7}) {
        std::vector<double> x, y, value;
        for (int k = 0; k < 200; ++k) {
          x.push_back(random.uniform(-3.0, 22.0));
          y.push_back(highest > 0.0 ? random.uniform(-1.0, 12.0) : 0.5);
          value.push_back(random.uniform());
        }
        y.back() = highest;
        const double period = periodic ? 20.0 : 0.0, farthest = periodic ? std::min(largest, 10.0) : largest;
        const PairCorrelation plain = plain_correlation(x, y, value, farthest, 10, period);
        const PairCorrelation result = pair_correlation(x, y, value, farthest, 10, period);
        EXPECT_EQ(result.pairs, plain.pairs) << largest;
        for (std::size_t bin = 0; bin < 10; ++bin)
          if (plain.pairs[bin] > 0.0)
            EXPECT_NEAR(result.value[bin], plain.value[bin], 1e-11) << largest;
          else
            EXPECT_TRUE(std::isnan(result.value[bin]));
      }
}

TEST(PairCorrelation, of_a_periodic_bed_counts_pairs_up_to_half_a_period) {
  const PairCorrelation result =
      pair_correlation({1.0, 9.0, 4.0}, {0.5, 0.5, 0.5}, {1.0, 2.0, 3.0}, 20.0, 20, 10.0);
  EXPECT_EQ(result.pairs, (std::vector<double>{0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(PairCorrelation, is_the_same_wherever_the_period_is_cut) {
  const Packing packing = test::random_packing(10, 200, 20.0, 12.0, true);
  const Packing moved = test::moved(packing, 7.25);
  const PairCorrelation one = stress_ratio_correlation(packing, 5.0, 10);
  const PairCorrelation other = stress_ratio_correlation(moved, 5.0, 10);
  EXPECT_EQ(one.pairs, other.pairs);
  for (std::size_t bin = 0; bin < 10; ++bin) EXPECT_NEAR(one.value[bin], other.value[bin], 1e-12);
}

// A common value at each depth, the weight above, is not a correlation: here each grain also has an
// independent random part.
TEST(MeanStressCorrelation, is_not_that_of_depth) {
  Packing packing = test::empty_packing(24.0, true);
  Random random(13);
  std::vector<double> mean_stress;
  for (Index row = 0; row < 24; ++row)
    for (Index column = 0; column < 24; ++column) {
      const double radius = random.uniform(0.4, 0.5);
      const double p = (26.0 - row) * random.uniform(0.5, 1.5);
      const double half_moment = 0.5 * p * pi * radius * radius;
      mean_stress.push_back(p);
      test::add_grain(packing, column, row, radius, {half_moment, 0.0, 0.0, half_moment});
    }
  const PairCorrelation raw = pair_correlation(packing.frame.x, packing.frame.y, mean_stress, 4.5, 3, 24.0);
  const PairCorrelation result = mean_stress_correlation(packing, 4.5, 3);
  for (std::size_t bin = 0; bin < 3; ++bin) {
    EXPECT_GT(raw.value[bin], 0.5);
    EXPECT_LT(std::fabs(result.value[bin]), 0.1);
  }
}

TEST(MeanStressCorrelation, does_not_depend_on_the_size_of_grains) {
  Packing packing = test::empty_packing(20.0, true);
  Random random(14);
  for (Index k = 0; k < 20; ++k) {
    const double radius = random.uniform(0.2, 0.5);
    const double p = k % 2 == 0 ? 1.0 : 3.0;
    test::add_grain(packing, k, 0.5, radius, {pi * radius * radius * p, 0.0, 0.0, 0.0});
  }
  EXPECT_NEAR(mean_stress_correlation(packing, 4.5, 9).value[2], -1.0, 1e-12);
}

TEST(ForceCorrelation, is_that_of_normal_forces_at_contact_points) {
  Packing packing = test::empty_packing(20.0, true);
  for (Index k = 0; k < 20; ++k) test::add_grain(packing, k + 0.25, 0.5);
  for (Index k = 0; k + 1 < 20; ++k) test::add_contact(packing, k, k + 1, k % 2 == 0 ? 1.0 : 3.0);
  test::add_contact(packing, 0, 19, 3.0, 0.0, -1);
  const PairCorrelation result = force_correlation(packing, 4.5, 9);
  EXPECT_EQ(result.pairs[2], 20.0);
  EXPECT_NEAR(result.value[2], -1.0, 1e-12);
  EXPECT_NEAR(result.value[4], 1.0, 1e-12);
}

}  // namespace
}  // namespace talus::analysis
