/// Chart of a reproduction with hand-made values.

#include "figures/agreement_figure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "unit/studies/like_the_paper.h"

namespace talus::figures {
namespace {

/// Returns the row with this label, counted from 1; 0 if there is none.
std::size_t row_of(const Figure& figure, const std::string& chart, const std::string& label) {
  for (const auto& [name, value] : figure.variables)
    if (name.starts_with(chart + "_row_") && value == '"' + label + '"')
      return std::stoul(name.substr(chart.size() + 5));
  return 0;
}

/// Returns the values of a column in a row, one per series.
std::vector<double> values_in(const Table& table, std::size_t row, const std::string& column) {
  const auto values = std::ranges::find(table.columns, column, &Column::name)->values;
  std::vector<double> found;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (table.columns.front().values[k] == static_cast<double>(row)) found.push_back(values[k]);
  return found;
}

TEST(AgreementFigure, of_the_papers_own_values_is_a_line_of_zeros) {
  const Figure figure = agreement_figure(studies::like_the_paper(0.0)).value();
  ASSERT_EQ(figure.tables.size(), 2u);
  for (const Table& table : figure.tables) {
    EXPECT_FALSE(table.columns.front().values.empty());
    for (const double score : table.columns[6].values) EXPECT_NEAR(score, 0.0, 1e-6) << table.name;
    EXPECT_EQ(std::ranges::count(table.columns[7].values, 0.0), 0) << table.name;
  }
  EXPECT_EQ(values_in(figure.tables[0], row_of(figure, "packing", "θ_c"), "score").size(), 3u);
  EXPECT_EQ(row_of(figure, "packing", "dilation from θ_d to θ_c"), 0u) << "the paper gives no number";
}

TEST(AgreementFigure, scores_are_differences_in_units_of_the_tolerance) {
  studies::ReproductionResult result = studies::like_the_paper(0.0);
  studies::set_everywhere(result, studies::PaperQuantity::theta_c, {18.0});  // of 20 +- 1
  studies::set_everywhere(result, studies::PaperQuantity::overloaded_at_0,
                          {std::numeric_limits<double>::quiet_NaN()});
  const Figure figure = agreement_figure(result).value();
  const std::size_t theta_c = row_of(figure, "packing", "θ_c");
  EXPECT_EQ(values_in(figure.tables[0], theta_c, "score"), std::vector<double>(3, -2.0));
  EXPECT_EQ(values_in(figure.tables[0], theta_c, "agrees"), std::vector<double>(3, 0.0));
  const auto absent = values_in(figure.tables[1], row_of(figure, "chain", "p_o at 0°"), "ours");
  ASSERT_EQ(absent.size(), 3u);
  EXPECT_TRUE(std::ranges::all_of(absent, [](double value) { return std::isnan(value); }));
}

TEST(AgreementFigure, leaves_out_what_cannot_be_compared) {
  studies::ReproductionResult result = studies::like_the_paper(0.0);
  for (ensemble::Variant& bed : result.plan.variants)
    bed.scenario.bed.depth = 20.0;  // lengths are limited by the depth
  const Figure figure = agreement_figure(result).value();
  EXPECT_EQ(row_of(figure, "chain", "mean {/:Italic ℓ}_c at 0°"), 0u);
  EXPECT_GT(row_of(figure, "chain", "p_o at 0°"), 0u);
}

TEST(AgreementFigure, needs_something_to_compare) {
  studies::ReproductionResult result = studies::like_the_paper(0.0);
  std::erase_if(result.outcomes, [&](const studies::ReproducedOutcome& outcome) {
    return studies::is_periodic(result.plan.variants[result.plan.members[outcome.member].variant]);
  });
  const Figure figure = agreement_figure(result).value();
  EXPECT_FALSE(figure.tables[0].columns.front().values.empty()) << "beds between walls";
  EXPECT_TRUE(figure.tables[1].columns.front().values.empty());
  result.outcomes.clear();
  EXPECT_FALSE(agreement_figure(result).has_value());
}

}  // namespace
}  // namespace talus::figures
