#include "figures/run_means.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/trigonometry.h"

namespace talus::figures {
namespace {

using Rows = std::vector<std::vector<double>>;

/// Three runs: the second ends first, and the third has half as many frames per angle.
const Rows tilts = {{0.0, 0.1, 0.2, 0.3, 0.4}, {0.0, 0.1, 0.2}, {0.0, 0.2 + 1e-9, 0.4}};

TEST(CommonTilts, AreThoseOfAtLeastHalfOfTheRuns) {
  const CommonTilts common = common_tilts(tilts);
  EXPECT_EQ(common.tilts, (std::vector<double>{0.0, 0.1, 0.2, 0.4})) << "0.3 has one run of three";
  ASSERT_EQ(common.samples.size(), 4u);
  ASSERT_EQ(common.samples[2].size(), 3u) << "round-off does not separate tilts";
  EXPECT_EQ(common.samples[2][2].run, 2u);
  EXPECT_EQ(common.samples[2][2].frame, 1u);
  EXPECT_EQ(common.samples[3].size(), 2u);
}

TEST(CommonTilts, OneRunOfTwoIsHalf) {
  EXPECT_EQ(common_tilts(std::span(tilts).first(2)).tilts.size(), 5u);
  EXPECT_TRUE(common_tilts({}).tilts.empty());
}

TEST(TiltColumns, AreDegreesAndCounts) {
  const std::vector<Column> columns = tilt_columns(common_tilts(tilts));
  ASSERT_EQ(columns.size(), 2u);
  EXPECT_EQ(columns[0].name, "theta");
  EXPECT_EQ(columns[0].unit, "deg");
  EXPECT_DOUBLE_EQ(columns[0].values[3], degrees(0.4));
  EXPECT_EQ(columns[1].name, "n");
  EXPECT_EQ(columns[1].values, (std::vector<double>{3.0, 2.0, 3.0, 2.0}));
}

TEST(MeanColumns, AreMeansWithStandardErrors) {
  const double nan = std::nan("");
  const Rows values = {{1.0, 1.0, 2.0, 9.0, 4.0}, {2.0, 3.0, 4.0}, {3.0, 9.0, nan}};
  const std::vector<Column> columns = mean_columns(common_tilts(tilts), values, {"p_o", "1", "fraction", {}});
  ASSERT_EQ(columns.size(), 3u);
  EXPECT_EQ(columns[0].name, "p_o");
  EXPECT_EQ(columns[0].values, (std::vector<double>{2.0, 2.0, 5.0, 4.0})) << "NaN does not count";
  EXPECT_EQ(columns[1].name, "p_o_error");
  EXPECT_DOUBLE_EQ(columns[1].values[0], 1.0 / std::sqrt(3.0)) << "s = 1 of three";
  EXPECT_DOUBLE_EQ(columns[1].values[1], 1.0) << "s = sqrt(2) of two";
  EXPECT_TRUE(std::isnan(columns[1].values[3])) << "one value has no error";
  EXPECT_EQ(columns[2].name, "p_o_deviation");
  EXPECT_DOUBLE_EQ(columns[2].values[0], 1.0);
  EXPECT_DOUBLE_EQ(columns[2].values[1], std::sqrt(2.0));
  EXPECT_TRUE(std::isnan(columns[2].values[3])) << "nor a deviation";
}

}  // namespace
}  // namespace talus::figures
