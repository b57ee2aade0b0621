#pragma once
/// What is run to stand beside the paper, and all that was measured in it.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "ensemble/plan.h"
#include "studies/readings.h"
#include "studies/wall_fit.h"

namespace talus::studies {

/// The variants are beds of the paper, or such a bed prepared in another way: periodic ones first, the
/// paper's before other preparations.
struct ReproductionPlan : ensemble::EnsemblePlan {
  bool quick = false;
};

/// The periodic bed with three preparations (deposition.method: poured, geometric, collapse) and five beds
/// between walls. `quick`: H = 20 D, walls at L = 50 ... 150 D, so the paper's H / L, and L = 100 D for the
/// periodic bed. They are members of an ensemble in `folder`. Throws as parse_seeds does.
ReproductionPlan plan_reproduction(bool quick, const std::string& seeds, const std::string& folder);

bool is_periodic(const ensemble::Variant& bed);
double depth_over_length(const ensemble::Variant& bed);

/// What a member that is done gave.
struct ReproducedOutcome {
  std::size_t member = 0;  ///< index into ReproductionPlan::members
  std::string version;     ///< of the Talus that computed it, with its git hash
  double seconds = 0.0;    ///< of its steps, on one thread
  /// By analysis, as chain_analyses() has them (of beds between walls those of the run file alone, the others
  /// are empty), then by threshold.
  std::vector<std::vector<MeasuredValues>> values;
  WallPoint wall;  ///< at failure, H the mean height then
};

struct ReproductionResult {
  ReproductionPlan plan;
  std::vector<ReproducedOutcome> outcomes;  ///< in the order of the plan
};

/// Those of a bed, by seed.
std::vector<const ReproducedOutcome*> outcomes_of(const ReproductionResult& result, std::size_t bed);

/// Of a bed, over its seeds, by an analysis; without one by that of the run file.
Spread spread_of(const ReproductionResult& result, std::size_t bed, PaperQuantity quantity,
                 const Reading& reading = {});

/// Every preparation of the periodic bed under every reading, by preparation; preparations without a complete
/// run are left out.
std::vector<ReadingResult> chain_results(const ReproductionResult& result);

/// At failure, of all runs between walls that have failed.
std::vector<WallPoint> wall_points(const ReproductionResult& result);

/// One row for each run, analysis, threshold and quantity, in full digits.
std::string values_csv(const ReproductionResult& result);

}  // namespace talus::studies
