/// Rule by which a value agrees with the paper's.

#include "studies/agreement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ensemble/plus_minus.h"

namespace talus::studies {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

PaperValue equal_to(double value, double accuracy, const char* unit = "1") {
  return {PaperQuantity::theta_c,      "name", "where", "text", value, accuracy, unit, Relation::equals, "",
          &analysis::Analysis::theta_c};
}
PaperValue above(double value) {
  return {PaperQuantity::dilation,     "name", "where", "text", value, 0.0, "1", Relation::above, "",
          &analysis::Analysis::theta_c};
}
Spread spread(std::initializer_list<MeasuredValue> values) { return spread_of(std::vector(values)); }
Agreement verdict_of(const PaperValue& paper, const Spread& ours) {
  return judge(paper, ours, paper_depth).agreement;
}

TEST(SpreadOfSeeds, is_mean_and_standard_deviation) {
  const Spread found = spread({{1.0}, {none}, {3.0}});
  EXPECT_EQ(found.runs, 3);
  EXPECT_EQ(found.values.count, 2);
  EXPECT_DOUBLE_EQ(found.values.mean, 2.0);
  EXPECT_DOUBLE_EQ(found.values.deviation, std::sqrt(2.0)) << "divided by n - 1";
  EXPECT_FALSE(found.at_most);
}

TEST(SpreadOfSeeds, of_one_or_none_has_no_deviation) {
  EXPECT_TRUE(std::isnan(spread({{1.0}}).values.deviation));
  EXPECT_TRUE(std::isnan(spread({{none}}).values.mean));
  EXPECT_TRUE(spread({{1.0}, {2.0, true}}).at_most);
  EXPECT_FALSE(spread({{1.0}, {none, true}}).at_most);
}

TEST(Judging, one_seed_goes_by_the_accuracy_of_the_paper) {
  const PaperValue paper = equal_to(15.0, 0.5);
  EXPECT_EQ(verdict_of(paper, spread({{15.5}})), Agreement::agrees) << "the tolerance itself";
  EXPECT_EQ(verdict_of(paper, spread({{14.5}})), Agreement::agrees);
  EXPECT_EQ(verdict_of(paper, spread({{15.51}})), Agreement::differs);
  EXPECT_EQ(verdict_of(paper, spread({{14.49}})), Agreement::differs);
}

TEST(Judging, several_seeds_add_one_standard_deviation) {
  const Spread ours = spread({{15.0}, {17.0}});  // 16 +- sqrt(2)
  const Judgement found = judge(equal_to(15.0, 0.5), ours, paper_depth);
  EXPECT_EQ(found.agreement, Agreement::agrees);
  EXPECT_DOUBLE_EQ(found.difference, 1.0);
  EXPECT_DOUBLE_EQ(found.tolerance, 0.5 + std::sqrt(2.0));
  EXPECT_EQ(verdict_of(equal_to(14.0, 0.5), ours), Agreement::differs);
}

TEST(Judging, above_needs_no_more_than_the_sign) {
  EXPECT_EQ(verdict_of(above(0.0), spread({{1e-6}})), Agreement::agrees);
  EXPECT_EQ(verdict_of(above(0.0), spread({{-1e-6}})), Agreement::differs);
  EXPECT_EQ(verdict_of(above(0.0), spread({{-1.0}, {0.5}})), Agreement::differs)
      << "a wide spread does not change the sign";
}

TEST(Judging, tells_what_does_not_occur_from_what_was_not_run) {
  EXPECT_EQ(verdict_of(equal_to(15.0, 0.5), spread({{none}, {none}})), Agreement::absent);
  const Judgement nothing = judge(equal_to(15.0, 0.5), spread({}), paper_depth);
  EXPECT_EQ(nothing.agreement, Agreement::not_comparable);
  EXPECT_NE(nothing.reason.find("no such run"), std::string::npos);
}

TEST(Judging, an_upper_bound_differs_only_where_it_is_below) {
  EXPECT_EQ(verdict_of(equal_to(15.0, 0.5), spread({{0.0, true}})), Agreement::differs);
  EXPECT_EQ(verdict_of(equal_to(0.45, 0.025), spread({{0.8, true}})), Agreement::not_comparable);
  EXPECT_EQ(verdict_of(equal_to(0.45, 0.025), spread({{0.45, true}})), Agreement::not_comparable)
      << "a close bound is not conclusive either";
}

TEST(Judging, lengths_of_another_depth_cannot_be_compared) {
  const PaperValue length = equal_to(5.0, 0.5, "D");
  EXPECT_EQ(judge(length, spread({{5.0}}), 20.0).agreement, Agreement::not_comparable);
  EXPECT_EQ(judge(length, spread({{5.0}}), 40.0).agreement, Agreement::agrees);
  EXPECT_EQ(judge(equal_to(5.0, 0.5, "deg"), spread({{5.0}}), 20.0).agreement, Agreement::agrees);
}

TEST(Judging, is_told_in_words) {
  const PaperValue paper = equal_to(0.3, 0.025);
  EXPECT_EQ(judgement_text(judge(paper, spread({{0.31}}), 40.0)), "agrees");
  EXPECT_EQ(judgement_text(judge(paper, spread({{0.92}}), 40.0)), "differs by +0.62 (tolerance 0.025)");
  EXPECT_EQ(judgement_text(judge(paper, spread({{none}}), 40.0)), "does not occur");
  EXPECT_EQ(judgement_text(judge(equal_to(5.0, 0.5, "D"), spread({{5.0}}), 20.0)),
            "not comparable: H = 20 D, not 40 D");
}

TEST(PlusMinus, has_two_digits_of_the_width) {
  EXPECT_EQ(ensemble::plus_minus(16.4321, 0.2096), "16.43 ± 0.21");
  EXPECT_EQ(ensemble::plus_minus(-0.5, 12.0), "-0 ± 12");
  EXPECT_EQ(ensemble::plus_minus(0.25, 0.1, true), "+0.25 ± 0.10");
  EXPECT_EQ(ensemble::plus_minus(-0.25, 0.1, true), "-0.25 ± 0.10");
  EXPECT_EQ(ensemble::plus_minus(1.0, 1e-30), "1.000000000000 ± 0.000000000000");
}

}  // namespace
}  // namespace talus::studies
