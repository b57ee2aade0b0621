#include "session/study_result.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "core/errors.h"
#include "core/hash.h"

namespace talus {
std::string version_of(const Facts& provenance) {
  std::string version, git_hash;
  for (const auto& [name, value] : provenance) {
    if (name == "version") version = value;
    if (name == "git_hash") git_hash = value;
  }
  return version + " (" + git_hash + ")";
}

std::string study_path(const std::string& folder, const StudyRun& run) {
  return (std::filesystem::path(folder) / (run.name + ".h5")).string();
}

double common_angle(const std::vector<RunReach>& reaches) {
  double lowest_failure = std::numeric_limits<double>::infinity();
  double lowest_end = lowest_failure;
  for (const RunReach& reached : reaches) {
    double& lowest = std::isnan(reached.theta_c) ? lowest_end : lowest_failure;
    lowest = std::min(lowest, std::isnan(reached.theta_c) ? reached.end : reached.theta_c);
  }
  // A tilt is a sum in radians: 3.0000000000000004 deg is meant to be 3.
  return std::min(std::floor(lowest_failure), std::round(1e6 * lowest_end) / 1e6);
}

StudyResult read_study(const StudyPlan& plan, const std::string& folder, std::optional<double> reference) {
  StudyResult result;
  result.plan = plan;
  std::vector<RunReach> reaches;
  for (std::size_t k = 0; k < plan.runs.size(); ++k) {
    const std::string path = study_path(folder, plan.runs[k]);
    if (run_presence(path) != RunPresence::packed) continue;
    const RunFile run = RunFile::open(path);
    reaches.push_back(reach(run));
    result.outcomes.push_back(
        {k, {}, hash_text(state_hash(run.checkpoint().world)), version_of(run.header().provenance)});
  }
  if (reaches.empty())
    throw Error(ExitCode::bad_data, folder + ": no run of the study is complete; nothing can be compared");
  result.reference = reference.value_or(common_angle(reaches));
  for (StudyOutcome& outcome : result.outcomes)
    outcome.figures =
        study_figures(RunFile::open(study_path(folder, plan.runs[outcome.run])), result.reference);
  return result;
}

std::vector<double> values_of(const StudyResult& result, std::size_t variation, StudyQuantity quantity) {
  const auto& seeds = result.plan.seeds;
  std::vector<double> values(seeds.size(), std::numeric_limits<double>::quiet_NaN());
  for (const StudyOutcome& outcome : result.outcomes) {
    const StudyRun& run = result.plan.runs[outcome.run];
    if (run.variation != variation) continue;
    const auto seed = std::ranges::lower_bound(seeds, run.seed);
    values[static_cast<std::size_t>(seed - seeds.begin())] = at(outcome.figures, quantity);
  }
  return values;
}

Comparison compare(const StudyResult& result, std::size_t variation, StudyQuantity quantity) {
  const std::vector<double> values = values_of(result, variation, quantity);
  return {mean_error(values), paired_difference(values, values_of(result, 0, quantity))};
}

}  // namespace talus
