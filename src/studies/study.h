#pragma once
/// A study: one scenario run again and again, each time with one thing changed, and each variation with the
/// same seeds. It shows what the figures of a run depend on, and what they do not (docs/study.md).

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/statistics.h"
#include "ensemble/plan.h"
#include "studies/study_figures.h"

namespace talus::studies {

/// One factor at a time: the scenario as it is (variant 0, the "baseline"), and beside it each value of each
/// axis alone, called "tilt.step=0.002" or "tilt.rate=2,tilt.step=0.002".
struct StudyPlan : ensemble::EnsemblePlan {
  std::string scenario_file;  ///< that is studied
  std::string baseline;       ///< its values of the keys that vary: "solver.tolerance=3e-07,tilt.step=0.001"
};

/// The scenario, and beside it each variation of each axis, as members of an ensemble in `folder`. `settings`
/// hold for all runs; an axis takes its keys out of them. A variation that is the baseline or an earlier
/// variation again is left out. Throws as plan_variants and parse_seeds do.
StudyPlan plan_study(const std::string& scenario_file, const std::vector<std::string>& settings,
                     const std::vector<std::string>& axes, const std::string& seeds,
                     const std::string& folder);

/// What a member that is done gave.
struct StudyOutcome {
  std::size_t member = 0;  ///< index into StudyPlan::members
  StudyFigures figures;
  std::string state_hash;
  std::string version;  ///< of the Talus that computed it, with its git hash
};

struct StudyResult {
  StudyPlan plan;
  double reference = 0.0;              ///< deg, the angle at which beds are compared
  std::vector<StudyOutcome> outcomes;  ///< of the members that are done, in the order of the plan
};

/// Reads the members of a study that are done. Beds are compared at `reference` deg; without a value at the
/// smallest theta_c of them, rounded down to a whole degree, or where no slope failed at the smallest last
/// tilt. Throws Error(bad_data) where none is done, and as numbers_of and RunFile::open do.
StudyResult read_study(const StudyPlan& plan, std::optional<double> reference);

/// The angle that read_study takes by itself, deg.
double common_angle(const std::vector<RunReach>& reaches);

/// The values of a quantity in a variant, one for each seed of the plan; NaN where there is none.
std::vector<double> values_of(const StudyResult& result, std::size_t variant, StudyQuantity quantity);

/// Over the seeds of a variant, and over the pairs of runs with the same seed in it and in the baseline.
struct Comparison {
  Statistics value;
  Statistics difference;
};
Comparison compare(const StudyResult& result, std::size_t variant, StudyQuantity quantity);

}  // namespace talus::studies
