/// The report of a reproduction whose values are made by hand.

#include "app/reproduction_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Two seeds that have the paper's values in everything, around them by `spread` of each.
ReproductionResult like_the_paper(double spread) {
  ReproductionResult result{plan_reproduction(false, "1-2"), {}};
  for (std::size_t r = 0; r < result.plan.runs.size(); ++r) {
    const ReproducedRun& run = result.plan.runs[r];
    const ReproducedBed& bed = result.plan.beds[run.bed];
    MeasuredValues values{};
    for (std::size_t q = 0; q < quantity_count; ++q) {
      const PaperValue paper = paper_value_of_walls(static_cast<PaperQuantity>(q), bed.depth_over_length());
      const double above = paper.relation == Relation::above ? 0.01 : 0.0;
      values[q] = {paper.value * (run.seed == 1 ? 1.0 - spread : 1.0 + spread) + above, false};
    }
    ReproducedOutcome outcome;
    outcome.run = r;
    outcome.version = "9.9.9 (abc)";
    outcome.seconds = 10.0;
    outcome.values.assign(bed.periodic() ? study_analyses(paper_depth).size() : 1, {values, values});
    outcome.values_of_all = {values, values};
    outcome.wall = {bed.depth_over_length(), paper_wall_ratio(bed.depth_over_length())};
    result.outcomes.push_back(outcome);
  }
  return result;
}

void set_everywhere(ReproductionResult& result, PaperQuantity quantity, Measured value) {
  const auto q = static_cast<std::size_t>(quantity);
  for (ReproducedOutcome& outcome : result.outcomes) {
    for (auto& analysis : outcome.values)
      for (MeasuredValues& values : analysis) values[q] = value;
    for (MeasuredValues& values : outcome.values_of_all) values[q] = value;
  }
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

bool holds(const std::vector<std::string>& sentences, const std::string& part) {
  return std::ranges::any_of(sentences,
                             [&](const auto& each) { return each.find(part) != std::string::npos; });
}

TEST(ReproductionReport, of_the_papers_own_values_agrees_everywhere) {
  const ReproductionResult result = like_the_paper(0.0);
  const std::string report = report_markdown(reproduction_report(result, {}));
  EXPECT_EQ(count_of(report, "differs"), 0u) << report;
  EXPECT_EQ(count_of(report, "does not occur"), 0u);
  const auto summary = reproduction_summary(result);
  EXPECT_TRUE(holds(summary, "values for the packing agree 12 of 12 with poured grains, 12 of 12 with"));
  EXPECT_TRUE(holds(summary, "k_L - k_0 = 2.50"));
  EXPECT_TRUE(holds(summary, "brings the paper's chain and ours together"));
  EXPECT_FALSE(holds(summary, "nothing that was tried"));
  EXPECT_FALSE(holds(summary, "No combination reaches"));
}

TEST(ReproductionReport, names_what_no_combination_reaches) {
  ReproductionResult result = like_the_paper(0.0);
  set_everywhere(result, PaperQuantity::overloaded_at_0, {0.8});
  set_everywhere(result, PaperQuantity::theta_d_by_percolation, {none});
  const auto summary = reproduction_summary(result);
  EXPECT_TRUE(holds(summary, "No combination reaches p_o at 0 deg (paper 0.3, nearest 0.800 ± 0"));
  EXPECT_TRUE(holds(summary, "theta_d: percolation (occurs in none)"));
  EXPECT_TRUE(holds(summary, "11 of 13 values agree"));
  EXPECT_TRUE(holds(summary, "So nothing that was tried brings the paper's chain and ours together."));
}

TEST(ReproductionReport, tells_which_change_helps_and_which_result_is_nearest) {
  ReproductionResult result = like_the_paper(0.0);
  set_everywhere(result, PaperQuantity::overloaded_at_0, {0.8});
  for (ReproducedOutcome& outcome : result.outcomes)
    if (result.plan.runs[outcome.run].bed == 1)  // geometric, single grains, three contacts
      outcome.values[2][1][static_cast<std::size_t>(PaperQuantity::overloaded_at_0)] = {0.3};
  const auto conclusion = threshold_conclusion(result.plan, study_of(result));
  EXPECT_TRUE(
      holds(conclusion,
            "Nearest to the paper's chain is `single grains, gamma >= 2 Gamma_c, grains with 3 contacts or "
            "more` with grains set down geometrically: 13 of 13"));
  EXPECT_TRUE(holds(conclusion, "no change raises that of `single grains, gamma >= Gamma_c`"));
  EXPECT_TRUE(
      holds(conclusion,
            "`grains with 3 contacts or more` raises that of `single grains, gamma >= 2 Gamma_c` most"));
}

TEST(ReproductionReport, has_the_chain_in_three_readings) {
  ReproductionResult result = like_the_paper(0.0);
  const std::size_t analyses[] = {1, 1, 0}, factors[] = {0, 1, 0};
  for (ReproducedOutcome& outcome : result.outcomes)
    for (std::size_t r = 0; r < 3 && outcome.values.size() > 1; ++r)
      outcome.values[analyses[r]][factors[r]][static_cast<std::size_t>(PaperQuantity::overloaded_at_0)] = {
          0.81 + 0.01 * static_cast<double>(r)};
  const std::string report = report_markdown(reproduction_report(result, {}));
  for (const char* row :
       {"single grains, gamma >= Gamma\\_c | 0.810", "single grains, gamma >= 2 Gamma\\_c | 0.820",
        "grains with first neighbours, gamma >= Gamma\\_c | 0.830"})
    EXPECT_NE(report.find(row), std::string::npos) << row << "\n" << report;
}

TEST(ReproductionReport, has_every_value_of_the_paper) {
  const std::string report = report_markdown(reproduction_report(like_the_paper(0.0), {}));
  for (const PaperValue& paper : paper_values) {
    std::string name = "| ";
    for (const char c : paper.name) name.append(c == '_' ? "\\" : "").push_back(c);
    EXPECT_NE(report.find(name), std::string::npos) << name;
  }
  for (const char* part : {"scenarios/paper-wbc-250.toml", "9.9.9 (abc)", "2 of 2"})
    EXPECT_NE(report.find(part), std::string::npos) << part;
}

TEST(ReproductionReport, without_a_bed_says_so) {
  ReproductionResult result = like_the_paper(0.0);
  std::erase_if(result.outcomes, [&](const auto& outcome) { return result.plan.runs[outcome.run].bed == 2; });
  const std::string report = report_markdown(reproduction_report(result, {}));
  EXPECT_NE(report.find("0 of 2"), std::string::npos);
  EXPECT_NE(report.find("not comparable: no such run is complete"), std::string::npos);
  result = like_the_paper(0.0);
  std::erase_if(result.outcomes, [&](const auto& outcome) { return result.plan.runs[outcome.run].bed == 1; });
  EXPECT_TRUE(holds(reproduction_summary(result),
                    "over all readings: 13.0 with poured grains and 13.0 with grains that collapse;"))
      << "a preparation that was not run has no score";
  result.outcomes.clear();
  EXPECT_TRUE(holds(reproduction_summary(result), "nothing is said about the threshold"));
}

TEST(SpreadText, has_the_digits_of_its_deviation) {
  EXPECT_EQ(spread_text({2, 2, 0.81499, 0.0123, false}), "0.815 ± 0.012");
  EXPECT_EQ(spread_text({3, 2, 15.1234, 1.5, false}), "15.1 ± 1.5 (2 of 3)");
  EXPECT_EQ(spread_text({1, 1, 0.99996, none, false}), "1.00");
  EXPECT_EQ(spread_text({1, 1, 0.0, none, true}), "<= 0.00");
  EXPECT_EQ(spread_text({1, 1, 119.2, none, false}), "119");
  EXPECT_EQ(spread_text({2, 2, 7.0, 0.0, false}), "7.00 ± 0");
  EXPECT_EQ(spread_text({2, 0, none, none, false}), "-");
}

TEST(ValuesCsv, has_a_row_for_each_value) {
  const ReproductionResult result = like_the_paper(0.1);
  const std::string csv = values_csv(result);
  const std::size_t periodic = 6 * (study_analyses(paper_depth).size() + 1), walls = 10 * 2;
  EXPECT_EQ(count_of(csv, "\n"), 1 + (periodic + walls) * 2 * quantity_count);
  EXPECT_NE(csv.find("pbc/seed-1,1,stored,1,p_o at 0 deg,1,0.27,0\n"), std::string::npos)
      << csv.substr(0, 900);
}

}  // namespace
}  // namespace talus
