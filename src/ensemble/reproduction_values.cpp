#include "ensemble/reproduction_values.h"

#include <filesystem>
#include <optional>

#include "core/errors.h"
#include "core/output_file.h"
#include "core/paths.h"
#include "ensemble/measured_file.h"
#include "ensemble/member_numbers.h"
#include "ensemble/member_state.h"
#include "io/analysis_file.h"
#include "io/durable_file.h"
#include "io/run_file.h"
#include "runs/analysis_parameters.h"
#include "runs/analysis_run.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

/// The values of a member by one analysis, one for each threshold.
using Thresholds = std::vector<MeasuredValues>;

/// The run of a member with its stored analysis; nothing where that is not the one with default parameters.
std::optional<RunView> stored_run(const std::string& path) {
  RunFile file = RunFile::open(path);
  std::optional<Analysis> stored = read_analysis(path);
  if (!stored || stored->key != analysis_key(file, AnalysisParameters())) return std::nullopt;
  return view_of_run(path, std::move(file), std::move(*stored));
}

Thresholds measure_thresholds(const RunView& run, Population population) {
  Thresholds thresholds;
  for (std::size_t f = 0; f < AnalysisParameters().threshold_factors.size(); ++f)
    thresholds.push_back(measure_all(run, f, population));
  return thresholds;
}

/// Where the values of an analysis that the run file does not hold are kept.
std::string reading_path(const std::string& run, const ChainAnalysis& analysis) {
  return (fs::path(file_beside(run, ".readings")) / (analysis.name + ".csv")).string();
}

/// Whether the bed is analysed for the readings: not between walls.
bool has_readings(const Member& member) { return member.scenario.bed.boundary == BedBoundary::periodic; }

std::optional<Thresholds> kept_reading(const RunFile& run, const std::string& path,
                                       const ChainAnalysis& analysis) {
  const std::string file = reading_path(path, analysis);
  if (!is_there(file)) return std::nullopt;
  return parse_measured(read_text(file), analysis_key(run, parse_analysis_settings(analysis.settings)));
}

/// The values of a member by each analysis, as chain_analyses() has them (of beds between walls those of the
/// run file alone, the others are empty); nothing where one is missing.
std::optional<std::vector<Thresholds>> values_of(const Member& member, const RunView& run) {
  std::vector<Thresholds> values;
  for (const ChainAnalysis& analysis : chain_analyses(member.scenario.bed.depth)) {
    std::optional<Thresholds> found = Thresholds();
    if (analysis.settings.empty())
      found = measure_thresholds(run, analysis.population);
    else if (has_readings(member))
      found = kept_reading(*run.file, member.path, analysis);
    if (!found) return std::nullopt;
    values.push_back(std::move(*found));
  }
  return values;
}

ReproducedOutcome measure_member(const ReproductionPlan& plan, std::size_t m) {
  const Member& member = plan.members[m];
  const std::optional<RunView> run = stored_run(member.path);
  auto values = run ? values_of(member, *run) : std::nullopt;
  const std::string numbers = numbers_path(member.path);
  if (!values)
    throw Error(ExitCode::bad_data, member.path + " lacks analyses of this version of Talus; remove " +
                                        numbers + ", and the member is analysed again");
  const MemberNumbers found = read_numbers(member);
  return {m, found.version, found.seconds, std::move(*values), wall_point(*run)};
}

}  // namespace

void make_readings(const Member& member) {
  if (!has_readings(member)) return;
  RunView run = view_of_run(member.path, RunFile::open(member.path), {});
  for (const ChainAnalysis& analysis : chain_analyses(member.scenario.bed.depth)) {
    if (analysis.settings.empty() || kept_reading(*run.file, member.path, analysis)) continue;
    run.analysis = analyse_run(*run.file, parse_analysis_settings(analysis.settings), 1, {});
    const std::string file = reading_path(member.path, analysis);
    prepare_folder_of(file);
    write_text(file, measured_text(run.analysis.key, measure_thresholds(run, Population::carrying)));
  }
}

bool is_measured(const Member& member) {
  if (run_presence(member.path) != RunPresence::packed) return false;
  const std::optional<RunView> run = stored_run(member.path);
  return run && values_of(member, *run);
}

ReproductionResult measure_members(const ReproductionPlan& plan) {
  ReproductionResult result{plan, {}};
  for (const std::size_t m : done_members(plan)) result.outcomes.push_back(measure_member(plan, m));
  return result;
}

}  // namespace talus
