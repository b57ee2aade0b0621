#include "analysis/overload/coarse_graining.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "stress/stress.h"
#include "unit/analysis/packings.h"

namespace talus::analysis {
namespace {

using test::Packing;

/// Returns distance and id of all free grains, nearest first, directly from the definition.
std::vector<std::pair<double, Index>> neighbours_of(const Packing& packing, Index centre) {
  std::vector<std::pair<double, Index>> near;
  for (Index i = 0; i < packing.statics.free_count; ++i) {
    double dx = std::fabs(packing.frame.x[i] - packing.frame.x[centre]);
    if (packing.statics.periodic) dx = std::min(dx, packing.statics.length - dx);
    const double dy = packing.frame.y[i] - packing.frame.y[centre];
    near.emplace_back(std::sqrt(dx * dx + dy * dy), i);
  }
  std::sort(near.begin(), near.end());
  return near;
}

/// Returns gamma_l from the sum over all grains within l/2.
double ratio_within(const Packing& packing, Index centre, double l) {
  Tensor2 sum;
  for (const auto& [distance, i] : neighbours_of(packing, centre)) {
    if (distance > 0.5 * l) break;
    const Tensor2& moment = packing.frame.internal_moment[i];
    sum = {sum.xx + moment.xx, sum.xy + moment.xy, sum.yx + moment.yx, sum.yy + moment.yy};
  }
  return stress::stress_state(sum).ratio;
}

double length_of(const Packing& packing, Index centre, const CoarseGrainingRule& rule) {
  const double first =
      rule.l_min > 0.0 ? ratio_within(packing, centre, rule.l_min) : packing.frame.gamma[centre];
  if (std::isnan(packing.frame.gamma[centre]) || !stress::is_overloaded(first, rule.threshold))
    return std::nan("");
  std::vector<double> candidates = {rule.l_min};
  for (const auto& [distance, i] : neighbours_of(packing, centre))
    if (2.0 * distance > rule.l_min && 2.0 * distance <= rule.cut) candidates.push_back(2.0 * distance);
  for (const double l : candidates)
    if (ratio_within(packing, centre, l) <= rule.end_ratio) return l;
  return rule.cut;
}

CoarseGraining graining(const Packing& packing, double threshold, double cut) {
  return coarse_graining(packing, {.threshold = threshold, .end_ratio = threshold, .l_min = 0.0, .cut = cut});
}

void expect_same_bits(const std::vector<double>& one, const std::vector<double>& other) {
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i)
    EXPECT_TRUE(one[i] == other[i] || (std::isnan(one[i]) && std::isnan(other[i])))
        << i << ": " << one[i] << ", " << other[i];
}

TEST(CoarseGraining, equals_the_definition_to_the_last_bit) {
  for (const bool periodic : {false, true})
    for (const auto& [threshold, end_ratio, l_min] :
         {std::array{0.05, 0.05, 0.0}, {0.3, 0.3, 0.0}, {0.2, 0.15, 3.0}, {0.2, 0.2, 3.0}, {0.2, 0.3, 3.0}}) {
      Packing packing = test::random_packing(5, 250, 20.5, 12.0, periodic);
      packing.frame.gamma[7] = std::nan("");
      const CoarseGrainingRule rule = {
          .threshold = threshold, .end_ratio = end_ratio, .l_min = l_min, .cut = 12.0};
      std::vector<double> expected;
      for (Index i = 0; i < 250; ++i) expected.push_back(length_of(packing, i, rule));
      const Frame frame = with_gamma_of_neighbourhoods(packing.frame, packing.statics, l_min);
      const CoarseGraining result = coarse_graining({frame, packing.statics}, rule);
      expect_same_bits(result.length, expected);
      EXPECT_TRUE(std::isnan(expected[7])) << "carries nothing";
      EXPECT_GT(result.largest, threshold < 0.1 ? 6.0 : l_min > 0.0 ? 4.0 : 2.0) << "too easy to be a test";
      EXPECT_EQ(std::ranges::count(result.length, 3.0) > 0, end_ratio > threshold);
    }
}

TEST(CoarseGraining, gamma_of_neighbourhoods_equals_the_definition_to_the_last_bit) {
  for (const bool periodic : {false, true}) {
    Packing packing = test::random_packing(6, 200, 20.5, 12.0, periodic);
    test::add_floor_grain(packing, 10.0, -0.5);
    packing.frame.gamma.back() = 0.75;
    packing.frame.gamma[3] = std::nan("");
    for (const double l_min : {0.0, 2.25, 3.0, 6.0}) {
      std::vector<double> expected = packing.frame.gamma;
      for (Index i = 0; l_min > 0.0 && i < 200; ++i)
        if (i != 3) expected[i] = ratio_within(packing, i, l_min);
      const Frame frame = with_gamma_of_neighbourhoods(packing.frame, packing.statics, l_min);
      expect_same_bits(frame.gamma, expected);
    }
  }
}

TEST(CoarseGraining, overloaded_over_scale_counts_neighbourhoods) {
  for (const bool periodic : {false, true}) {
    Packing packing = test::random_packing(7, 200, 20.5, 12.0, periodic);
    packing.frame.gamma[3] = std::nan("");
    constexpr double threshold = 0.2;
    const std::vector<double> scales = {0.0, 1.5, 3.0, 3.0, 9.0, 11.0};
    std::vector<double> expected;
    for (const double l : scales) {
      int overloaded = 0;
      for (Index i = 0; i < 200; ++i)
        if (i != 3 && ratio_within(packing, i, l) >= threshold) ++overloaded;
      expected.push_back(overloaded / 199.0);
    }
    EXPECT_NE(expected[2], expected[4]);
    expect_same_bits(overloaded_over_scale(packing, threshold, scales), expected);
  }
}

TEST(CoarseGraining, of_the_map_equals_the_definition_to_the_last_bit) {
  for (const bool periodic : {false, true}) {
    const Packing packing = test::random_packing(2, 250, 20.5, 12.0, periodic);
    for (const double l : {5.0, 20.0}) {
      std::vector<double> expected;
      for (Index i = 0; i < 250; ++i) expected.push_back(ratio_within(packing, i, l));
      expect_same_bits(coarse_stress_ratio(packing, l), expected);
    }
  }
}

TEST(CoarseGraining, of_a_checkerboard) {
  Packing packing = test::empty_packing(16.0, true);
  for (Index row = 0; row < 16; ++row)
    for (Index column = 0; column < 16; ++column)
      test::add_grain(packing, column, row, 0.5,
                      (row + column) % 2 == 0 ? Tensor2{1.0, 0.0, 0.0, 0.0} : Tensor2{1.0, 0.0, 0.0, 1.0});
  // In the middle: Q = number of even grains, P = even + 2 odd. 1/1; 1/9 with 4 odd at 1; 5/13 with 4 even at
  // sqrt(2).
  const Index middle = 8 * 16 + 8;
  EXPECT_EQ(graining(packing, 0.2, 8.0).length[middle], 2.0);
  EXPECT_EQ(graining(packing, 0.2, 8.0).overloaded, 128);
  const NeighbourhoodCurve curve = neighbourhood_curve(packing, middle, 3.0);
  ASSERT_EQ(curve.l.size(), 3u);
  EXPECT_EQ(curve.l[1], 2.0);
  EXPECT_EQ(curve.l[2], 2.0 * std::sqrt(2.0));
  EXPECT_EQ(curve.gamma[0], 1.0);
  EXPECT_EQ(curve.gamma[1], 1.0 / 9.0);
  EXPECT_EQ(curve.gamma[2], 5.0 / 13.0);
}

// A neighbourhood contains all grains within l/2 and is not evaluated between grains at equal distance. One
// neighbour alone would reduce gamma_l to 0; the four together give 3/5.
TEST(CoarseGraining, takes_grains_at_one_distance_together) {
  Packing packing = test::empty_packing(10.0, false);
  const Tensor2 along = {1.0, 0.0, 0.0, 0.0};
  test::add_grain(packing, 5.0, 5.0, 0.5, along);
  test::add_grain(packing, 6.0, 5.0, 0.5, {0.0, 0.0, 0.0, 1.0});
  test::add_grain(packing, 4.0, 5.0, 0.5, along);
  test::add_grain(packing, 5.0, 6.0, 0.5, along);
  test::add_grain(packing, 5.0, 4.0, 0.5, along);
  EXPECT_EQ(graining(packing, 0.5, 8.0).length[0], 8.0);
}

TEST(CoarseGraining, leaves_out_the_floor) {
  Packing packing = test::empty_packing(10.0, false);
  test::add_grain(packing, 5.0, 5.0, 0.5, {1.0, 0.0, 0.0, 0.0});
  const Index floor = test::add_floor_grain(packing, 5.0, 4.0);
  packing.frame.internal_moment[floor] = {0.0, 0.0, 0.0, 1.0};
  test::gamma_from_moments(packing);
  const CoarseGraining result = graining(packing, 0.5, 8.0);
  ASSERT_EQ(result.length.size(), 1u);
  EXPECT_EQ(result.cut_off, 1);
}

TEST(CoarseGraining, summary) {
  Packing packing = test::empty_packing(100.0, false);
  const Tensor2 along = {1.0, 0.0, 0.0, 0.0};
  const Tensor2 across = {0.0, 0.0, 0.0, 1.0};
  test::add_grain(packing, 10.0, 0.0, 0.5, along);  // with the next grain, l_c = 2
  test::add_grain(packing, 11.0, 0.0, 0.5, across);
  test::add_grain(packing, 50.0, 0.0, 0.5, along);  // isolated up to the cut-off of 8
  const CoarseGraining result = graining(packing, 0.5, 8.0);
  EXPECT_EQ(result.overloaded, 3);
  EXPECT_EQ(result.cut_off, 1);
  EXPECT_EQ(result.mean, 4.0);
  EXPECT_EQ(result.largest, 8.0);
  EXPECT_NEAR(result.standard_error, std::sqrt((4.0 + 4.0 + 16.0) / 2.0 / 3.0), 1e-15);
}

}  // namespace
}  // namespace talus::analysis
