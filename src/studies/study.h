#pragma once
/// A study: one scenario run repeatedly, each time with one change and with the same seeds. It shows which
/// parameters the results of a run depend on (docs/study.md).

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/statistics.h"
#include "ensemble/plan.h"
#include "studies/study_figures.h"

namespace talus::studies {

/// Plan of a study with one factor at a time: the scenario itself (variant 0, the "baseline") and each value
/// of each axis alone, with names such as "tilt.step=0.002" or "tilt.rate=2,tilt.step=0.002".
struct StudyPlan : ensemble::EnsemblePlan {
  std::string scenario_file;  ///< scenario under study
  std::string baseline;  ///< baseline values of the varied keys: "solver.tolerance=3e-07,tilt.step=0.001"
};

/// Plans the scenario and each variation of each axis as members of an ensemble in `folder`. `settings` apply
/// to all runs; an axis overrides its keys. Variations that equal the baseline or an earlier variation are
/// left out. Throws as plan_variants and parse_seeds do.
StudyPlan plan_study(const std::string& scenario_file, const std::vector<std::string>& settings,
                     const std::vector<std::string>& axes, const std::string& seeds,
                     const std::string& folder);

/// Results of a completed member.
struct StudyOutcome {
  std::size_t member = 0;  ///< index into StudyPlan::members
  StudyFigures figures;
  std::string state_hash;
  std::string version;  ///< version of Talus that computed it, with its git hash
};

/// A study with the results of its completed members.
struct StudyResult {
  StudyPlan plan;
  double reference = 0.0;              ///< angle at which beds are compared, deg
  std::vector<StudyOutcome> outcomes;  ///< one for each completed member, in the order of the plan
};

/// Reads the completed members of a study. Beds are compared at `reference` deg, by default at the smallest
/// theta_c rounded down to a whole degree, or at the smallest final tilt if no slope has failed. Throws
/// Error(bad_data) if no member is complete, and as numbers_of and RunFile::open do.
StudyResult read_study(const StudyPlan& plan, std::optional<double> reference);

/// Returns the default reference angle of read_study, deg.
double common_angle(const std::vector<RunReach>& reaches);

/// Returns the values of a quantity in a variant, one for each seed of the plan; NaN for a missing value.
std::vector<double> values_of(const StudyResult& result, std::size_t variant, StudyQuantity quantity);

/// Statistics over the seeds of a variant, and of the differences between runs with the same seed in the
/// variant and in the baseline.
struct Comparison {
  Statistics value;
  Statistics difference;
};
/// Compares a variant with the baseline.
Comparison compare(const StudyResult& result, std::size_t variant, StudyQuantity quantity);

}  // namespace talus::studies
