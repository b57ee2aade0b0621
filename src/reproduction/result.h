#pragma once
/// All that was measured to stand beside the paper.

#include <string>
#include <vector>

#include "analysis/wall_fit.h"
#include "reproduction/plan.h"
#include "reproduction/threshold_study.h"

namespace talus {

/// What a complete run gave.
struct ReproducedOutcome {
  std::size_t run = 0;   ///< index into ReproductionPlan::runs
  std::string version;   ///< of the Talus that computed it, with its git hash
  double seconds = 0.0;  ///< of its steps, on one thread
  /// By analysis (those of study_analyses(); of beds between walls the stored one alone), then by threshold.
  std::vector<std::vector<MeasuredValues>> values;
  std::vector<MeasuredValues> values_of_all;  ///< the stored analysis with p_o over all grains
  WallPoint wall;                             ///< at failure, H the mean height then
};

struct ReproductionResult {
  ReproductionPlan plan;
  std::vector<ReproducedOutcome> outcomes;  ///< in the order of the plan
};

/// Of a bed, over its seeds, by the stored analysis.
Spread spread_of(const ReproductionResult& result, std::size_t bed, PaperQuantity quantity);
/// The same of a periodic bed under one of base_readings().
Spread spread_of(const ReproductionResult& result, std::size_t bed, PaperQuantity quantity,
                 const Reading& reading);

/// Every preparation of the periodic bed under every reading, by preparation; preparations without a complete
/// run are left out.
std::vector<ReadingResult> study_of(const ReproductionResult& result);

/// At failure, of all runs between walls that have failed.
std::vector<WallPoint> wall_points(const ReproductionResult& result);

/// One row for each run, analysis, threshold and quantity, in full digits.
std::string values_csv(const ReproductionResult& result);

}  // namespace talus
