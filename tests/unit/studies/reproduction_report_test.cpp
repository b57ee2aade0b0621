/// Report of a reproduction with hand-made values.

#include "studies/reproduction_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "support/temporary_folder.h"
#include "unit/studies/like_the_paper.h"

namespace talus::studies {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::string page_of(const ReproductionResult& result) {
  return report_html(reproduction_report(result, {}), ".");
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
  const std::string report = page_of(result);
  EXPECT_EQ(count_of(report, "differs"), 0u) << report;
  EXPECT_EQ(count_of(report, "does not occur"), 0u);
  const auto summary = reproduction_summary(result);
  EXPECT_TRUE(
      holds(summary, "values for the packing, these agree: 12 of 12 with poured grains, 12 of 12 with"));
  EXPECT_TRUE(holds(summary, "k_L - k_0 = 2.50"));
  EXPECT_TRUE(holds(summary, "reconciles the paper's chain with ours"));
  EXPECT_FALSE(holds(summary, "nothing that was tried"));
  EXPECT_FALSE(holds(threshold_conclusion(result.plan, chain_results(result)), "No combination reaches"));
}

TEST(ReproductionReport, names_what_no_combination_reaches) {
  ReproductionResult result = like_the_paper(0.0);
  set_everywhere(result, PaperQuantity::overloaded_at_0, {0.8});
  set_everywhere(result, PaperQuantity::theta_d_by_percolation, {none});
  const auto conclusion = threshold_conclusion(result.plan, chain_results(result));
  EXPECT_TRUE(holds(conclusion, "No combination reaches p_o at 0 deg (paper 0.3, nearest 0.800 ± 0"));
  EXPECT_TRUE(holds(conclusion, "theta_d: percolation (occurs in none)"));
  for (const auto& sentences : {conclusion, reproduction_summary(result)}) {
    EXPECT_TRUE(holds(sentences, "11 of 13 values agree"));
    EXPECT_TRUE(holds(sentences, "So no reading that was tried reconciles the paper's chain with ours."));
  }
}

TEST(ReproductionReport, tells_which_change_helps_and_which_result_is_nearest) {
  ReproductionResult result = like_the_paper(0.0);
  set_everywhere(result, PaperQuantity::overloaded_at_0, {0.8});
  for (ReproducedOutcome& outcome : result.outcomes)
    if (result.plan.members[outcome.member].variant == 1)  // geometric, single grains, three contacts
      outcome.values[2][1][static_cast<std::size_t>(PaperQuantity::overloaded_at_0)] = {0.3};
  const auto conclusion = threshold_conclusion(result.plan, chain_results(result));
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
    for (std::size_t r = 0; r < 3 && !outcome.values[1].empty(); ++r)
      outcome.values[analyses[r]][factors[r]][static_cast<std::size_t>(PaperQuantity::overloaded_at_0)] = {
          0.81 + 0.01 * static_cast<double>(r)};
  const std::string report = page_of(result);
  for (const char* row :
       {"single grains, gamma &gt;= Gamma_c</td><td class=\"number bad\">0.810",
        "single grains, gamma &gt;= 2 Gamma_c</td><td class=\"number bad\">0.820",
        "grains with first neighbours, gamma &gt;= Gamma_c</td><td class=\"number bad\">0.830"})
    EXPECT_NE(report.find(row), std::string::npos) << row << "\n" << report;
}

TEST(ReproductionReport, has_every_value_of_the_paper) {
  const std::string report = page_of(like_the_paper(0.0));
  for (const PaperValue& paper : paper_values)
    EXPECT_NE(report.find(std::string("<td>").append(paper.name)), std::string::npos) << paper.name;
  for (const char* part : {"talus run scenarios/wbc-250.toml", "9.9.9 (abc)", "2 of 2"})
    EXPECT_NE(report.find(part), std::string::npos) << part;
}

TEST(ReproductionReport, opens_with_the_result_and_has_each_figure_in_its_part) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path("p.png"), std::ios::binary) << "PNG";
  const auto picture = [](const char* title) { return ReportPicture{"p.png", title, "Caption.", false}; };
  const std::string page = report_html(
      reproduction_report(
          like_the_paper(0.0),
          {{picture("one")}, {picture("two")}, {picture("three")}, {picture("four")}, {picture("five")}}),
      folder.path().string());
  std::size_t at = 0;
  for (const char* part :
       {"<nav>", ">In short<", "alt=\"one\"", ">The packing</h2>", "<table>", "alt=\"two\"",
        ">Overloaded grains, lengths and the transition</h2>", "alt=\"three\"", ">Beds between walls</h2>",
        "alt=\"four\"", ">Further figures</h2>", "alt=\"five\"", ">What was run</h2>",
        ">How values are compared</h2>", ">How each number is measured</h2>"}) {
    const std::size_t found = page.find(part, at);
    ASSERT_NE(found, std::string::npos) << part << " after byte " << at;
    at = found;
  }
}

TEST(ReproductionReport, without_a_bed_says_so) {
  ReproductionResult result = like_the_paper(0.0);
  std::erase_if(result.outcomes,
                [&](const auto& outcome) { return result.plan.members[outcome.member].variant == 2; });
  const std::string report = page_of(result);
  EXPECT_NE(report.find("0 of 2"), std::string::npos);
  EXPECT_NE(report.find("not comparable: no such run is complete"), std::string::npos);
  result = like_the_paper(0.0);
  std::erase_if(result.outcomes,
                [&](const auto& outcome) { return result.plan.members[outcome.member].variant == 1; });
  EXPECT_TRUE(holds(threshold_conclusion(result.plan, chain_results(result)),
                    "over all readings: 13.0 with poured grains and 13.0 with grains that collapse;"))
      << "a preparation that was not run has no score";
  result.outcomes.clear();
  EXPECT_TRUE(holds(reproduction_summary(result), "nothing can be concluded about the threshold"));
}

TEST(SpreadText, has_the_digits_of_its_deviation) {
  const auto text = [](int runs, Statistics values, bool at_most = false) {
    return spread_text({runs, values, at_most});
  };
  EXPECT_EQ(text(2, {2, 0.81499, 0.0123}), "0.815 ± 0.012");
  EXPECT_EQ(text(3, {2, 15.1234, 1.5}), "15.1 ± 1.5 (2 of 3)");
  EXPECT_EQ(text(1, {1, 0.99996, none}), "1.00");
  EXPECT_EQ(text(1, {1, 0.0, none}, true), "<= 0.00");
  EXPECT_EQ(text(1, {1, 119.2, none}), "119");
  EXPECT_EQ(text(2, {2, 7.0, 0.0}), "7.00 ± 0");
  EXPECT_EQ(text(2, {0, none, none}), "-");
}

TEST(ValuesCsv, has_a_row_for_each_value) {
  const ReproductionResult result = like_the_paper(0.1);
  const std::string csv = values_csv(result);
  const std::size_t periodic = 6 * chain_analyses(paper_depth).size(), walls = 10 * 2;
  EXPECT_EQ(count_of(csv, "\n"), 1 + (periodic + walls) * 2 * quantity_count);
  EXPECT_NE(csv.find("pbc/seed-1,1,stored,1,p_o at 0 deg,1,0.27,0\n"), std::string::npos)
      << csv.substr(0, 900);
}

}  // namespace
}  // namespace talus::studies
