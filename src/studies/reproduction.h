#pragma once
/// Beds that are run for comparison with the paper, and the values measured in them.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "ensemble/plan.h"
#include "studies/readings.h"
#include "studies/wall_fit.h"

namespace talus::studies {

/// Plan whose variants are the paper's beds and the periodic bed prepared in other ways: periodic beds first,
/// the paper's before other preparations.
struct ReproductionPlan : ensemble::EnsemblePlan {
  bool quick = false;
};

/// Plans the periodic bed with three preparations (deposition.method: poured, geometric, collapse) and five
/// beds between walls, as members of an ensemble in `folder`. `quick`: H = 20 D, with L = 50 ... 150 D
/// between walls, which keeps the paper's H / L, and L = 100 D for the periodic bed. Throws as parse_seeds
/// does.
ReproductionPlan plan_reproduction(bool quick, const std::string& seeds, const std::string& folder);

/// Whether the bed has a periodic boundary.
bool is_periodic(const ensemble::Variant& bed);
/// Returns the nominal H / L of a bed.
double depth_over_length(const ensemble::Variant& bed);

/// Values of one complete member.
struct ReproducedOutcome {
  std::size_t member = 0;  ///< index into ReproductionPlan::members
  std::string version;     ///< version of Talus that computed it, with its git hash
  double seconds = 0.0;    ///< processor time of its steps, s
  /// Values by analysis, in the order of chain_analyses(), then by threshold. Beds between walls have only
  /// those of the stored analysis.
  std::vector<std::vector<MeasuredValues>> values;
  WallPoint wall;  ///< ratio at failure; H is the mean height at failure
};

/// A reproduction with the values of its completed members.
struct ReproductionResult {
  ReproductionPlan plan;
  std::vector<ReproducedOutcome> outcomes;  ///< complete members, in the order of the plan
};

/// Returns the outcomes of a bed, by seed.
std::vector<const ReproducedOutcome*> outcomes_of(const ReproductionResult& result, std::size_t bed);

/// Returns the values of a bed over its seeds under a reading; by default that of the stored analysis.
Spread spread_of(const ReproductionResult& result, std::size_t bed, PaperQuantity quantity,
                 const Reading& reading = {});

/// Judges every preparation of the periodic bed under every reading, ordered by preparation; preparations
/// without a complete run are left out.
std::vector<ReadingResult> chain_results(const ReproductionResult& result);

/// Returns the points at failure of all runs between walls that have failed.
std::vector<WallPoint> wall_points(const ReproductionResult& result);

/// Writes one CSV row for each run, analysis, threshold and quantity, in full digits.
std::string values_csv(const ReproductionResult& result);

}  // namespace talus::studies
