/// Readings of the paper's definitions, their scores, and conclusions.

#include "studies/readings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "runs/analysis_parameters.h"

namespace talus::studies {
namespace {

/// Returns a run that has the paper's value for every quantity.
MeasuredValues like_the_paper() {
  MeasuredValues values{};
  for (std::size_t q = 0; q < quantity_count; ++q) values[q] = {paper_values[q].value, false};
  return values;
}

MeasuredValue& value(MeasuredValues& values, PaperQuantity quantity) {
  return values[static_cast<std::size_t>(quantity)];
}

ReadingResult result_of(std::size_t preparation, std::size_t reading, const MeasuredValues& run,
                        double depth = paper_depth) {
  return judge_reading(preparation, reading, std::span(&run, 1), depth);
}

TEST(Readings, are_of_single_grains_with_either_threshold_and_of_grains_with_first_neighbours) {
  const std::vector<ChainAnalysis> analyses = chain_analyses(paper_depth);
  const std::pair<double, std::size_t> expected[] = {{0.0, 0}, {0.0, 1}, {3.0, 0}};  // l_min, factor
  ASSERT_EQ(base_readings().size(), std::size(expected));
  for (std::size_t b = 0; b < std::size(expected); ++b) {
    const Reading& base = base_readings()[b];
    const analysis::AnalysisParameters parameters =
        runs::parse_analysis_settings(analyses[base.analysis].settings);
    EXPECT_EQ(parameters.l_min, expected[b].first) << base.base;
    EXPECT_EQ(base.factor, expected[b].second) << base.base;
    analysis::AnalysisParameters defaults;
    defaults.l_min = parameters.l_min;
    EXPECT_EQ(runs::as_facts(parameters), runs::as_facts(defaults)) << "nothing else is changed";
  }
  EXPECT_EQ(base_readings().back().analysis, 0u) << "the value of the run file";
}

TEST(Readings, change_one_factor_from_their_base) {
  const std::vector<ChainAnalysis> analyses = chain_analyses(paper_depth);
  const Reading* base = nullptr;
  for (const Reading& reading : readings()) {
    if (reading.change.empty()) base = &reading;
    ASSERT_NE(base, nullptr);
    EXPECT_EQ(reading.base, base->base);
    EXPECT_EQ(reading.factor, base->factor);
    const ChainAnalysis& analysis = analyses[reading.analysis];
    const bool changed = reading.analysis != base->analysis;
    EXPECT_EQ(changed, !reading.change.empty()) << reading.change;
    EXPECT_EQ(runs::parse_analysis_settings(analysis.settings).l_min == 0.0, base->base.starts_with("single"))
        << analysis.name;
  }
  EXPECT_EQ(readings().size(), 20u);
  EXPECT_EQ(analyses[6].name, "l_min=0,lc_cut=30");
  EXPECT_EQ(chain_analyses(20.0)[6].name, "l_min=0,lc_cut=15") << "3/4 of the depth";
}

TEST(Score, counts_what_agrees) {
  MeasuredValues run = like_the_paper();
  const int all = static_cast<int>(chain_values().size());
  EXPECT_EQ(result_of(0, 0, run).agreeing, all);
  EXPECT_EQ(result_of(0, 0, run).comparable, all);
  value(run, PaperQuantity::overloaded_at_0).value = 0.8;
  value(run, PaperQuantity::theta_d_by_percolation).value = std::numeric_limits<double>::quiet_NaN();
  value(run, PaperQuantity::solid_fraction).value = 0.1;
  EXPECT_EQ(result_of(0, 0, run).agreeing, all - 2) << "the solid fraction does not depend on the chain";
  EXPECT_EQ(result_of(0, 0, run).comparable, all) << "a missing event is a difference";
}

TEST(Score, of_a_shallow_bed_leaves_lengths_out) {
  const ReadingResult result = result_of(0, 0, like_the_paper(), 20.0);
  EXPECT_EQ(result.comparable, static_cast<int>(chain_values().size()) - 6);
  EXPECT_EQ(result.agreeing, result.comparable);
}

TEST(Deviation, is_the_median_of_the_chain) {
  MeasuredValues run = like_the_paper();
  EXPECT_DOUBLE_EQ(result_of(0, 0, run).deviation, 0.0);
  const std::size_t first = static_cast<std::size_t>(chain_values().front().quantity);
  const std::size_t count = chain_values().size();
  ASSERT_EQ(count, 13u) << "an odd number: the median is the seventh";
  for (std::size_t v = 0; v < count; ++v)
    run[first + v].value = chain_values()[v].value * (1.0 + 0.1 * static_cast<double>(v));
  EXPECT_NEAR(result_of(0, 0, run).deviation, 0.6, 1e-12);
  for (std::size_t v = 0; v < 7; ++v) run[first + v].value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isinf(result_of(0, 0, run).deviation)) << "half of them do not occur";
}

TEST(Conclusion, breaks_a_tie_of_scores_by_the_deviation) {
  MeasuredValues near = like_the_paper(), far = like_the_paper();
  for (std::size_t q = 0; q < quantity_count; ++q) {
    near[q].value *= 1.6;
    far[q].value *= 1.7;
  }
  const ReadingResult results[] = {result_of(0, 0, far), result_of(0, 1, near), result_of(1, 1, near)};
  ASSERT_EQ(results[0].agreeing, results[1].agreeing);
  EXPECT_EQ(conclude(results).best, (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(conclude(results).smallest_deviation, 1u);
}

TEST(Conclusion, names_the_best_and_what_none_reaches) {
  MeasuredValues near = like_the_paper(), far = like_the_paper();
  value(near, PaperQuantity::overloaded_at_0).value = 0.4;
  value(far, PaperQuantity::overloaded_at_0).value = 0.8;
  value(far, PaperQuantity::overloaded_at_theta_c).value = 0.9;
  for (MeasuredValues* run : {&near, &far})
    value(*run, PaperQuantity::theta_d_by_percolation).value = std::numeric_limits<double>::quiet_NaN();
  const ReadingResult results[] = {result_of(0, 0, far), result_of(0, 1, near), result_of(1, 0, far)};
  const ChainConclusion conclusion = conclude(results);
  EXPECT_EQ(conclusion.best, std::vector<std::size_t>{1});
  EXPECT_FALSE(conclusion.complete);
  ASSERT_EQ(conclusion.missed.size(), 2u);
  EXPECT_EQ(chain_values()[conclusion.missed[0].value].quantity, PaperQuantity::overloaded_at_0);
  EXPECT_EQ(conclusion.missed[0].nearest, 1u);
  EXPECT_EQ(chain_values()[conclusion.missed[1].value].quantity, PaperQuantity::theta_d_by_percolation);
  EXPECT_FALSE(conclusion.missed[1].nearest.has_value());
  const double all = static_cast<double>(chain_values().size());
  EXPECT_EQ(conclusion.score_of_reading, (std::vector<double>{all - 3, all - 2}));
  EXPECT_EQ(conclusion.score_of_preparation, (std::vector<double>{all - 2.5, all - 3}));
}

TEST(Conclusion, is_complete_where_all_agrees) {
  const ReadingResult results[] = {result_of(0, 0, like_the_paper()), result_of(1, 0, like_the_paper())};
  const ChainConclusion conclusion = conclude(results);
  EXPECT_EQ(conclusion.best.size(), 2u);
  EXPECT_TRUE(conclusion.complete);
  EXPECT_TRUE(conclusion.missed.empty());
}

}  // namespace
}  // namespace talus::studies
