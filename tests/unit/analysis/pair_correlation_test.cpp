#include "analysis/pair_correlation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "core/trigonometry.h"
#include "unit/analysis/packings.h"

namespace talus {
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
  // Bins are half a diameter wide: distances 1, 2, 3, 4 are at the beginning of every other one.
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

TEST(PairCorrelation, equals_the_sum_over_all_pairs) {
  for (const bool periodic : {false, true}) {
    const Packing packing = test::random_packing(8, 200, 20.0, 12.0, periodic);
    std::vector<double> value;
    Random random(9);
    double mean = 0.0;
    for (int k = 0; k < 200; ++k) {
      value.push_back(random.uniform());
      mean += value.back() / 200.0;
    }
    double variance = 0.0;
    for (double each : value) variance += (each - mean) * (each - mean) / 200.0;
    std::vector<double> sums(10, 0.0), pairs(10, 0.0);
    for (std::size_t i = 0; i < 200; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        double dx = std::fabs(packing.frame.x[i] - packing.frame.x[j]);
        if (periodic) dx = std::min(dx, 20.0 - dx);
        const double r = std::hypot(dx, packing.frame.y[i] - packing.frame.y[j]);
        if (r >= 5.0) continue;
        sums[static_cast<std::size_t>(r / 0.5)] += (value[i] - mean) * (value[j] - mean);
        ++pairs[static_cast<std::size_t>(r / 0.5)];
      }
    const PairCorrelation result =
        pair_correlation(packing.frame.x, packing.frame.y, value, 5.0, 10, periodic ? 20.0 : 0.0);
    EXPECT_EQ(result.pairs, pairs);
    for (std::size_t bin = 0; bin < 10; ++bin)
      EXPECT_NEAR(result.value[bin], sums[bin] / pairs[bin] / variance, 1e-12);
  }
}

TEST(PairCorrelation, is_the_same_wherever_the_period_is_cut) {
  const Packing packing = test::random_packing(10, 200, 20.0, 12.0, true);
  const Packing moved = test::moved(packing, 7.25);
  const PairCorrelation one = stress_ratio_correlation(packing, 5.0, 10);
  const PairCorrelation other = stress_ratio_correlation(moved, 5.0, 10);
  EXPECT_EQ(one.pairs, other.pairs);
  for (std::size_t bin = 0; bin < 10; ++bin) EXPECT_NEAR(one.value[bin], other.value[bin], 1e-12);
}

// What all grains at one depth share, the weight above, is no correlation: here each has its own random part.
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
}  // namespace talus
