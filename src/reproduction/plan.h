#pragma once
/// What is run to stand beside the paper: its beds, and how many of each.

#include <cstdint>
#include <string>
#include <vector>

#include "session/scenario.h"

namespace talus {

/// A bed of the paper, or that bed prepared in another way.
struct ReproducedBed {
  std::string name;                   ///< "pbc", "pbc-friction-0.15", "wbc-100": its folder
  std::string scenario_name;          ///< "paper-pbc": the built-in scenario
  std::vector<std::string> settings;  ///< "key=value", all that changes in it
  Scenario scenario;                  ///< what they give, with the seed of the file

  bool periodic() const { return scenario.bed.boundary == BedBoundary::periodic; }
  double depth_over_length() const { return scenario.bed.depth / scenario.bed.length; }
};

struct ReproducedRun {
  std::size_t bed = 0;  ///< index into ReproductionPlan::beds
  std::uint64_t seed = 0;
  std::string name;  ///< "pbc/seed-1": the path of its file below the folder of runs, without ".h5"
  Scenario scenario;
};

struct ReproductionPlan {
  bool quick = false;
  std::vector<std::uint64_t> seeds;  ///< ascending
  std::vector<ReproducedBed> beds;   ///< periodic ones first, the paper's before other preparations
  std::vector<ReproducedRun> runs;   ///< seed by seed, in each the cheapest first
};

/// The periodic bed with three preparations (deposition.method: poured, geometric, collapse) and five beds
/// between walls. `quick`: H = 20 D, walls at L = 50 ... 150 D, so the paper's H / L, and L = 100 D for the
/// periodic bed. Throws as parse_seeds does.
ReproductionPlan plan_reproduction(bool quick, const std::string& seeds);

/// The runs of a bed, as indices into the plan, by seed.
std::vector<std::size_t> runs_of(const ReproductionPlan& plan, std::size_t bed);

}  // namespace talus
