#pragma once
/// Hand-made results of a reproduction.

#include <cstddef>

#include "studies/reproduction.h"

namespace talus::studies {

/// Returns two seeds with all values of the paper, varied by `spread` of each.
inline ReproductionResult like_the_paper(double spread) {
  ReproductionResult result{plan_reproduction(false, "1-2", "folder"), {}};
  for (std::size_t r = 0; r < result.plan.members.size(); ++r) {
    const ensemble::Member& run = result.plan.members[r];
    const ensemble::Variant& bed = result.plan.variants[run.variant];
    MeasuredValues values{};
    for (std::size_t q = 0; q < quantity_count; ++q) {
      const PaperValue paper = paper_value_of_walls(static_cast<PaperQuantity>(q), depth_over_length(bed));
      const double above = paper.relation == Relation::above ? 0.01 : 0.0;
      values[q] = {paper.value * (run.seed == 1 ? 1.0 - spread : 1.0 + spread) + above, false};
    }
    ReproducedOutcome outcome;
    outcome.member = r;
    outcome.version = "9.9.9 (abc)";
    outcome.seconds = 10.0;
    for (const ChainAnalysis& analysis : chain_analyses(paper_depth))
      if (is_periodic(bed) || analysis.settings.empty())
        outcome.values.push_back({values, values});
      else
        outcome.values.emplace_back();
    outcome.wall = {depth_over_length(bed), paper_wall_ratio(depth_over_length(bed))};
    result.outcomes.push_back(outcome);
  }
  return result;
}

/// Sets a value in all analyses and thresholds of all runs.
inline void set_everywhere(ReproductionResult& result, PaperQuantity quantity, MeasuredValue value) {
  const auto q = static_cast<std::size_t>(quantity);
  for (ReproducedOutcome& outcome : result.outcomes) {
    for (auto& analysis : outcome.values)
      for (MeasuredValues& values : analysis) values[q] = value;
  }
}

}  // namespace talus::studies
