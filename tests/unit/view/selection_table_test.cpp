/// Values of selected grains, and their table.

#include "view/selection_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/statistics.h"
#include "core/trigonometry.h"

namespace talus::view {
namespace {

const double nan = std::nan("");
const std::vector<double> values = {3.0, nan, 1.0, 2.0, 1.0, 100.0};
const std::vector<Index> grains = {0, 1, 2, 3, 4};

TEST(TableOfGrains, values_that_are_not_there_do_not_count) {
  const Statistics statistics = talus::statistics_of(known_values(grains, values));
  EXPECT_EQ(statistics.count, 4);
  EXPECT_DOUBLE_EQ(statistics.mean, 1.75);
  EXPECT_DOUBLE_EQ(statistics.deviation, std::sqrt((1.5625 + 2 * 0.5625 + 0.0625) / 3.0));
  EXPECT_EQ(known_values(grains, values), (std::vector<double>{3.0, 1.0, 2.0, 1.0}));
  EXPECT_TRUE(known_values(std::vector<Index>{1}, values).empty());
}

TEST(TableOfGrains, is_sorted_with_those_without_a_value_at_its_end) {
  EXPECT_EQ(sorted_by(grains, values, false), (std::vector<Index>{2, 4, 3, 0, 1}));
  EXPECT_EQ(sorted_by(grains, values, true), (std::vector<Index>{0, 3, 2, 4, 1}));
}

TEST(TableOfGrains, histograms_are_densities) {
  const std::vector<Index> all = {0, 1, 2, 3, 4, 5};
  const Plot plot = histogram_of(analysis::grain_number("lc"), grains, all, values);
  ASSERT_EQ(plot.series.size(), 2u);
  EXPECT_EQ(plot.x_title, "lc (D)");
  for (const PlotSeries& series : plot.series) {
    double area = 0.0;
    for (std::size_t k = 1; k < series.x.size(); ++k) area += series.y[k] * (series.x[k] - series.x[k - 1]);
    EXPECT_NEAR(area, 1.0, 1e-12) << series.name;
    EXPECT_EQ(series.x.front(), 1.0);
    EXPECT_EQ(series.x.back(), 100.0);
  }
  EXPECT_TRUE(
      histogram_of(analysis::grain_number("lc"), grains, std::vector<Index>{1}, values).series.empty());
  EXPECT_EQ(histogram_of(analysis::grain_number("lc"), grains, std::vector<Index>{0}, values).series.size(),
            2u)
      << "a single value has a bin too";
}

TEST(TableOfGrains, is_csv_with_units) {
  Frame frame;
  frame.time = 2.5;
  frame.tilt = radians(10.0);
  const std::vector<double> ids = {0, 1, 2, 3, 4, 5};
  const std::vector<analysis::GrainNumber> numbers = {analysis::grain_number("id"),
                                                      analysis::grain_number("lc")};
  const auto values_of = [&](const analysis::GrainNumber& number) -> const std::vector<double>& {
    return number.name == "id" ? ids : values;
  };
  const std::string tilt = "2.5,10";
  EXPECT_EQ(grains_table(frame, std::vector<Index>{0, 1}, numbers, values_of),
            "time (s),tilt (deg),id,lc (D)\n" + tilt + ",0,3\n" + tilt + ",1,\n");
}

}  // namespace
}  // namespace talus::view
