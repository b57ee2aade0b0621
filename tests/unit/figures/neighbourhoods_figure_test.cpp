#include <gtest/gtest.h>

#include <cmath>

#include "figures/recipes.h"
#include "unit/analysis/packings.h"

namespace talus::figures {
namespace {

constexpr float none = std::numeric_limits<float>::quiet_NaN();

/// Returns grains at heights 0.5 ... 7.5 in the middle of a bed 10 m long, of which those with ids 2 ... 5
/// are in its middle half, and two floor grains.
test::Packing column_of_grains() {
  test::Packing packing = test::empty_packing(10.0, true);
  for (int i = 0; i < 8; ++i) test::add_grain(packing, 5.0, 0.5 + i);
  test::add_floor_grain(packing, 4.5, -0.5);
  test::add_floor_grain(packing, 5.5, -0.5);
  return packing;
}

TEST(TypicalGrain, IsNearestToTheMeansAtAllThresholds) {
  const test::Packing packing = column_of_grains();
  const analysis::FrameThreshold first{.lc = {4, 4, 4, 5, 4.4f, 3, 4, 4, none, none}, .lc_mean = 4.0};
  const analysis::FrameThreshold second{.lc = {2, 2, 4, 2, 2.1f, 2, 2, 2, none, none}, .lc_mean = 2.0};
  EXPECT_EQ(typical_grain(packing, std::vector{first, second}), 4);
  EXPECT_EQ(typical_grain(packing, std::vector{first}), 2);
}

TEST(TypicalGrain, IsOverloadedAndOfEqualOnesTheFirst) {
  const test::Packing packing = column_of_grains();
  const std::vector lengths = {
      analysis::FrameThreshold{.lc = {4, 4, none, 5, 3, none, 4, 4, none, none}, .lc_mean = 4.0}};
  EXPECT_EQ(typical_grain(packing, lengths), 3);
  const std::vector nobody = {
      analysis::FrameThreshold{.lc = {4, 4, none, none, none, none, 4, 4, none, none}, .lc_mean = 4.0}};
  EXPECT_EQ(typical_grain(packing, nobody), std::nullopt);
}

TEST(TypicalGrain, IsAwayFromWalls) {
  test::Packing packing = column_of_grains();
  packing.frame.x[3] = 9.0;
  const std::vector lengths = {
      analysis::FrameThreshold{.lc = {none, none, none, 4, 5, none, none, none, none, none}, .lc_mean = 4.0}};
  EXPECT_EQ(typical_grain(packing, lengths), 3) << "periodic";
  packing.statics.periodic = false;
  EXPECT_EQ(typical_grain(packing, lengths), 4);
}

TEST(GrainsAround, AreSeenFromTheGrainAcrossThePeriodicEdge) {
  test::Packing packing = test::empty_packing(20.0, true);
  packing.statics.mean_diameter = 2.0;
  test::add_grain(packing, 19.0, 5.0, 0.9);
  test::add_grain(packing, 1.0, 6.0, 1.1);   // at distance 2 to the right
  test::add_grain(packing, 15.0, 8.0, 1.0);  // at distance 5 exactly
  test::add_grain(packing, 15.0, 8.1, 1.0);
  test::add_floor_grain(packing, 19.0, 4.0);
  packing.frame.gamma = {0.1, 0.2, 0.3, 0.4, 0.5};
  const Table table = grains_around(packing, 0, 5.0);
  EXPECT_EQ(table.columns[0].values, (std::vector<double>{0, 1, -2}));
  EXPECT_EQ(table.columns[1].values, (std::vector<double>{0, 0.5, 1.5}));
  EXPECT_EQ(table.columns[2].values, (std::vector<double>{0.45, 0.55, 0.5}));
  EXPECT_EQ(table.columns[3].values, (std::vector<double>{0.1, 0.2, 0.3}));
}

}  // namespace
}  // namespace talus::figures
