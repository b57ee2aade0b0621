#pragma once
/// What a study found: the figures of its runs, and each variation compared with the baseline.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "session/study.h"
#include "session/study_figures.h"
#include "session/study_statistics.h"

namespace talus {

/// The version that computed a run, with its git hash, from its provenance.
std::string version_of(const Facts& provenance);

/// The file of a run of the study below `folder`.
std::string study_path(const std::string& folder, const StudyRun& run);

/// What was read from a complete run.
struct StudyOutcome {
  std::size_t run = 0;  ///< index into StudyPlan::runs
  StudyFigures figures;
  std::string state_hash;
  std::string version;  ///< of the Talus that computed it, with its git hash
};

struct StudyResult {
  StudyPlan plan;
  double reference = 0.0;              ///< deg, the angle at which beds are compared
  std::vector<StudyOutcome> outcomes;  ///< of the complete runs, in the order of the plan
};

/// Reads the complete runs of a study. Beds are compared at `reference` deg; without a value at the smallest
/// theta_c of them, rounded down to a whole degree, or where no slope failed at the smallest last tilt.
/// Throws Error(bad_data) where no run is complete, and as RunFile::open does.
StudyResult read_study(const StudyPlan& plan, const std::string& folder, std::optional<double> reference);

/// The angle that read_study takes by itself, deg.
double common_angle(const std::vector<RunReach>& reaches);

/// The values of a quantity in a variation, one for each seed of the plan; NaN where there is none.
std::vector<double> values_of(const StudyResult& result, std::size_t variation, StudyQuantity quantity);

/// Over the seeds of a variation, and over the pairs of runs with the same seed in it and in the baseline.
struct Comparison {
  MeanError value;
  MeanError difference;
};
Comparison compare(const StudyResult& result, std::size_t variation, StudyQuantity quantity);

}  // namespace talus
