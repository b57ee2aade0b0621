/// Section of the reproduction report on the reading of the threshold.

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "scenario/text.h"
#include "studies/reproduction_report.h"

namespace talus::studies {
namespace {

std::string reading_text(const Reading& reading) {
  return reading.base + (reading.change.empty() ? "" : ", " + reading.change);
}

std::string result_text(const ReproductionPlan& plan, const ReadingResult& result) {
  return fmt::format("`{}` with {}", reading_text(readings()[result.reading]),
                     preparation_text(plan.variants[result.preparation]));
}

std::string score_text(const ReadingResult& result) {
  return fmt::format("{} of {}", result.agreeing, result.comparable);
}

/// "27 %"; "-" where half of the values do not occur.
std::string deviation_text(const ReadingResult& result) {
  return std::isfinite(result.deviation) ? fmt::format("{:.0f} %", 100.0 * result.deviation) : "-";
}

/// The values of the chain as heads of columns.
std::vector<TextColumn> chain_columns() {
  std::vector<TextColumn> columns = {{"reading"}};
  for (const PaperValue& paper : chain_values()) columns.push_back({name_text(paper), true});
  columns.push_back({"agree", true});
  columns.push_back({"half within", true});
  return columns;
}

/// A value without its seeds missing: columns are narrow.
TextCell chain_cell(const Spread& spread, const Judgement& judgement) {
  const Tone tone = judgement.agreement == Agreement::agrees           ? Tone::good
                    : judgement.agreement == Agreement::not_comparable ? Tone::muted
                                                                       : Tone::plain;
  return {spread_text(spread), judgement.agreement == Agreement::agrees ? "agrees" : "", tone};
}

TextTable preparation_table(std::span<const ReadingResult> results, std::size_t preparation) {
  TextTable table{chain_columns(), {}};
  std::vector<TextCell> paper = {{"the paper", "", Tone::muted}};
  for (const PaperValue& value : chain_values())
    paper.push_back({fmt::format("{:.3g}", value.value), "", Tone::muted});
  paper.resize(table.columns.size());
  table.rows.push_back(std::move(paper));
  for (const ReadingResult& result : results) {
    if (result.preparation != preparation) continue;
    const Reading& reading = readings()[result.reading];
    std::vector<TextCell> row = {reading.change.empty() ? TextCell{reading.base}
                                                        : TextCell{"", reading.change}};
    for (std::size_t v = 0; v < result.values.size(); ++v)
      row.push_back(chain_cell(result.values[v], result.judgements[v]));
    row.push_back({score_text(result)});
    row.push_back({deviation_text(result)});
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string best_text(const ReproductionPlan& plan, std::span<const ReadingResult> results,
                      const ChainConclusion& conclusion) {
  constexpr std::size_t most = 3;
  std::vector<std::string> names;
  for (const std::size_t r : conclusion.best)
    if (names.size() < most) names.push_back(result_text(plan, results[r]));
  const std::size_t more = conclusion.best.size() - names.size();
  if (more > 0) names.push_back(fmt::format("{} more", more));
  return fmt::format(
      "Nearest to the paper's chain {}{}: {} values agree, half lie within {} of the paper's{}",
      conclusion.best.size() > 1 ? "are " : "is ", listed(names),
      score_text(results[conclusion.best.front()]), deviation_text(results[conclusion.best.front()]),
      conclusion.best.size() > 1 ? ", in each." : ".");
}

/// Names a result other than the best one that has the smallest deviation.
std::string least_text(const ReproductionPlan& plan, std::span<const ReadingResult> results,
                       std::size_t least) {
  return fmt::format("{} has the smallest median deviation: {}, with {} that agree.",
                     result_text(plan, results[least]), deviation_text(results[least]),
                     score_text(results[least]));
}

std::string scores_text(const ReproductionPlan& plan, const ChainConclusion& conclusion) {
  std::vector<std::string> preparations, bases;
  for (std::size_t p = 0; p < conclusion.score_of_preparation.size(); ++p)
    if (!std::isnan(conclusion.score_of_preparation[p]))
      preparations.push_back(fmt::format("{:.1f} with {}", conclusion.score_of_preparation[p],
                                         preparation_text(plan.variants[p])));
  for (std::size_t r = 0; r < conclusion.score_of_reading.size(); ++r)
    if (readings()[r].change.empty())
      bases.push_back(fmt::format("{:.1f} for `{}`", conclusion.score_of_reading[r], readings()[r].base));
  return fmt::format(
      "Mean number of values that agree, over all readings: {}; over preparations, with nothing else "
      "changed: {}.",
      listed(preparations), listed(bases));
}

/// The change of each base that raises its score most, over preparations.
std::string changes_text(const ChainConclusion& conclusion) {
  std::vector<std::string> texts;
  for (std::size_t base = 0; base < conclusion.score_of_reading.size(); ++base) {
    if (!readings()[base].change.empty()) continue;
    std::size_t best = base;
    for (std::size_t r = base + 1; r < conclusion.score_of_reading.size() && !readings()[r].change.empty();
         ++r)
      if (conclusion.score_of_reading[r] > conclusion.score_of_reading[best]) best = r;
    texts.push_back(best == base
                        ? fmt::format("no change raises that of `{}`", readings()[base].base)
                        : fmt::format("`{}` raises that of `{}` most, to {:.1f}", readings()[best].change,
                                      readings()[base].base, conclusion.score_of_reading[best]));
  }
  return fmt::format("Of the changes to a reading, {}.", listed(texts));
}

std::string missed_text(const ReproductionPlan& plan, std::span<const ReadingResult> results,
                        const ChainConclusion& conclusion) {
  std::vector<std::string> texts;
  for (const auto& [value, nearest] : conclusion.missed) {
    const PaperValue& paper = chain_values()[value];
    std::string text(paper.name);
    if (nearest)
      text += fmt::format(" (paper {:.3g}, nearest {}, {})", paper.value,
                          spread_text(results[*nearest].values[value]), result_text(plan, results[*nearest]));
    else
      text += " (occurs in none)";
    texts.push_back(text);
  }
  return fmt::format("No combination reaches {}.", listed(texts));
}

/// Introduces the question and the readings of the definitions.
std::vector<ReportBlock> introduction() {
  return {ReportHeading{2, "Settling which grains are overloaded"},
          ReportParagraph{
              "The paper leaves open how its beds were made and some details of its data processing. "
              "Here its definitions are varied for each preparation, one factor at a time, from "
              "three readings: single grains with the printed threshold, single grains with twice it, and "
              "grains taken together with their first neighbours, within 1.5 D, with the printed threshold. "
              "\"Agree\" counts the values of the chain that agree with the paper's, each by the rule above; "
              "\"half within\" is the median of |ours - paper| / paper over the chain. They show how near a "
              "reading comes, not why; the values of one chain are not independent."},
          ReportList{{
              "p_o over all grains: not only over those that carry a force.",
              ("Grains with 3 contacts or more: a grain held by two contacts has gamma near 1 whatever its "
               "load; here it does not count."),
              "Moments averaged over 1 deg: the internal moment of each grain is a mean over 1 deg of tilt.",
              ("Neighbours joined: overloaded grains form a cluster if their centres are closer than 1.1 "
               "times the sum of their radii, in contact or not."),
              "l_c cut as in the paper: at 30 D of 40 D, so at 3/4 of the depth; otherwise at the depth.",
              ("l_c ends at Gamma_c: grains are overloaded if gamma >= 2 Gamma_c, but their neighbourhoods "
               "grow until the stress ratio is Gamma_c."),
              ("Neighbourhoods of at least 4 D: a grain is taken together with all within 2 D of it, and l_c "
               "is at least 4 D."),
          }}};
}

}  // namespace

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k)
    text += (k == 0 ? "" : k + 1 == words.size() ? " and " : ", ") + words[k];
  return text;
}

std::vector<std::string> threshold_verdict(const ReproductionPlan& plan,
                                           std::span<const ReadingResult> results) {
  if (results.empty())
    return {"No periodic bed is complete, so nothing can be concluded about the threshold."};
  const ChainConclusion conclusion = conclude(results);
  return {best_text(plan, results, conclusion),
          conclusion.complete ? "So the nearest reading reconciles the paper's chain with ours."
                              : "So no reading that was tried reconciles the paper's chain with ours."};
}

std::vector<std::string> threshold_conclusion(const ReproductionPlan& plan,
                                              std::span<const ReadingResult> results) {
  std::vector<std::string> sentences = threshold_verdict(plan, results);
  if (results.empty()) return sentences;
  const ChainConclusion conclusion = conclude(results);
  const std::string verdict = sentences.back();
  sentences.pop_back();
  const auto least = conclusion.smallest_deviation;
  if (least && std::isfinite(results[*least].deviation) && std::ranges::count(conclusion.best, *least) == 0)
    sentences.push_back(least_text(plan, results, *least));
  sentences.push_back(scores_text(plan, conclusion));
  sentences.push_back(changes_text(conclusion));
  if (!conclusion.missed.empty()) sentences.push_back(missed_text(plan, results, conclusion));
  sentences.push_back(verdict);
  return sentences;
}

std::vector<ReportBlock> threshold_blocks(const ReproductionResult& result) {
  const std::vector<ReadingResult> results = chain_results(result);
  std::vector<ReportBlock> blocks = introduction();
  for (std::size_t b = 0; b < result.plan.variants.size(); ++b) {
    if (std::ranges::none_of(results, [b](const ReadingResult& each) { return each.preparation == b; }))
      continue;
    const std::string preparation = preparation_text(result.plan.variants[b]);
    blocks.emplace_back(ReportHeading{3, "The bed with " + preparation});
    blocks.emplace_back(preparation_table(results, b));
  }
  blocks.emplace_back(ReportHeading{3, "What follows"});
  blocks.emplace_back(ReportList{threshold_conclusion(result.plan, results)});
  return blocks;
}

}  // namespace talus::studies
