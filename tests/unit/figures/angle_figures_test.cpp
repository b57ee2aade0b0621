/// Histograms and correlations of the angles of an ensemble.

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "core/trigonometry.h"
#include "figures/recipes.h"
#include "support/blank_analysis.h"

namespace talus::figures {
namespace {

const double nan = std::nan("");

/// Returns a run that has only values: theta_c, and theta_d from the jump of l_c, deg.
runs::RunView run_with(std::uint64_t seed, double theta_c, double jump) {
  runs::RunView run;
  run.path = "e.h5#seed-" + std::to_string(seed);
  run.scenario.seed = seed;
  run.analysis = test::blank_analysis({.frames = 1, .thresholds = 2});
  run.analysis.thresholds[0].factor = 1.0;
  run.analysis.thresholds[1].factor = 2.0;
  run.analysis.theta_c = radians(theta_c);
  run.analysis.thresholds[0].lc_jump = radians(jump);
  run.analysis.thresholds[1].lc_jump = radians(jump + 1.0);
  return run;
}

const std::vector<double>& column(const Table& table, const std::string& name) {
  for (const Column& each : table.columns)
    if (each.name == name) return each.values;
  throw std::out_of_range(name);
}

const Table& table_called(const Figure& figure, const std::string& name) {
  for (const Table& table : figure.tables)
    if (table.name == name) return table;
  throw std::out_of_range(name);
}

std::string variable(const Figure& figure, const std::string& name) {
  for (const auto& [key, value] : figure.variables)
    if (key == name) return value;
  return "not there";
}

class AngleFigures : public ::testing::Test {
 protected:
  AngleFigures() {
    groups.resize(2);
    groups[0].label = "a";
    groups[1].label = "b";
    for (const double angle : {18.0, 19.0, 19.5, 20.0, 22.0}) add(0, angle, angle - 4.0);
    for (const double angle : {20.0, 21.0, 23.0}) add(1, angle, angle == 21.0 ? nan : -angle);
  }
  void add(std::size_t group, double theta_c, double jump) {
    groups[group].runs.push_back(run_with(groups[group].runs.size() + 1, theta_c, jump));
  }
  std::vector<RunGroup> groups;
};

TEST_F(AngleFigures, ShowTheAnglesThatRunsHave) {
  const auto figure = angle_distributions(groups);
  ASSERT_TRUE(figure);
  EXPECT_EQ(variable(*figure, "panels"), "3") << "theta_c, and theta_d from the jump at both thresholds";
  EXPECT_EQ(variable(*figure, "bins_2"), "\"angle-distributions-bins-theta_d-lc_jump.csv\"");
  EXPECT_EQ(variable(*figure, "bins_3"), "\"angle-distributions-bins-theta_d-lc_jump-1.csv\"");
  EXPECT_EQ(variable(*figure, "summary_1_1"), "\"mean 19.70 ± 0.66, median 19.50, n = 5\"");
  EXPECT_EQ(variable(*figure, "summary_2_2"), "\"mean -21.5 ± 1.5, median -21.50, n = 2\"");
  EXPECT_EQ(figure->runs.size(), 8u);
  EXPECT_NEAR(column(figure->tables[0], "theta_d/lc_jump[1]")[4], 19.0, 1e-12);
  const Table& bins = table_called(*figure, "bins-theta_c");
  for (const char* share : {"share_1", "share_2"}) {
    const std::vector<double>& shares = column(bins, share);
    EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.0), 1.0, 1e-12);
    EXPECT_EQ(shares.front(), 0.0);
    EXPECT_EQ(shares.back(), 0.0);
  }
}

TEST_F(AngleFigures, CountEachValueInItsBin) {
  const Table bins = table_called(*angle_distributions(groups), "bins-theta_c");
  const std::vector<double>&from = column(bins, "from"), &to = column(bins, "to");
  for (std::size_t b = 0; b < from.size(); ++b) {
    double share = 0.0;
    for (const double angle : {18.0, 19.0, 19.5, 20.0, 22.0})
      if (angle > from[b] - 1e-9 && angle < to[b] - 1e-9) share += 0.2;
    EXPECT_NEAR(column(bins, "share_1")[b], share, 1e-12) << from[b];
  }
}

TEST(HistogramBins, AreRoundAndHoldAllValues) {
  std::vector<double> values = {nan};
  for (int k = 0; k < 100; ++k) values.push_back(18.0 + 0.02 * k);
  const HistogramBins bins = bins_for(values);
  EXPECT_DOUBLE_EQ(bins.width, 0.25) << "below 2 x 0.99 / 100^(1/3) = 0.43";
  EXPECT_LE(bins.first + bins.width, 18.0);
  EXPECT_GE(bins.first + static_cast<double>(bins.count - 1) * bins.width, 19.98);
  const HistogramBins same = bins_for({3.0, 3.0});
  EXPECT_DOUBLE_EQ(same.width, 0.5);
  EXPECT_EQ(same.count, 3u);
  std::vector<double> outlier(50, 1.0);
  for (std::size_t k = 0; k < 25; ++k) outlier[k] = 1.001;
  outlier[0] = 100.0;
  EXPECT_LE(bins_for(outlier).count, 60u) << "few bins for a few distant values";
  EXPECT_GT(bins_for(outlier).count, 10u);
}

TEST_F(AngleFigures, CorrelateThePairsAtTheFirstThreshold) {
  const auto figure = angle_correlations(groups);
  ASSERT_TRUE(figure);
  EXPECT_EQ(variable(*figure, "angles"), "2");
  EXPECT_EQ(variable(*figure, "r_1_2_1"), "\"{/:Italic r} = 1.00\"");
  EXPECT_EQ(variable(*figure, "r_1_2_2"), "\"\"") << "two runs have no correlation coefficient";
  const Table& coefficients = table_called(*figure, "coefficients");
  EXPECT_NEAR(column(coefficients, "r_1")[0], 1.0, 1e-12);
  EXPECT_EQ(column(coefficients, "n_1")[0], 5.0);
  EXPECT_EQ(column(coefficients, "n_2")[0], 2.0);
  EXPECT_TRUE(std::isnan(column(coefficients, "r_2")[0]));
}

TEST_F(AngleFigures, NeedSeveralRunsOfAGroup) {
  groups[0].runs.resize(1);
  groups[1].runs.resize(1);
  EXPECT_FALSE(angle_distributions(groups));
  EXPECT_FALSE(angle_correlations(groups));
}

}  // namespace
}  // namespace talus::figures
