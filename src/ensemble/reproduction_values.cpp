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
#include "session/analysis_parameters.h"
#include "session/analysis_run.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

/// The values of a member by one analysis, one for each threshold.
using Thresholds = std::vector<MeasuredValues>;

/// The stored analysis where it is the one with default parameters.
std::optional<Analysis> stored_analysis(const RunFile& run, const std::string& path) {
  std::optional<Analysis> stored = read_analysis(path);
  if (stored && stored->key != analysis_key(run, AnalysisParameters())) stored.reset();
  return stored;
}

Thresholds measure_thresholds(const RunFile& run, const Analysis& analysis, Population population) {
  const MeasuredRun measured{run.frame_tilts(), run.header().statics.mean_diameter, analysis};
  Thresholds thresholds;
  for (std::size_t f = 0; f < AnalysisParameters().threshold_factors.size(); ++f)
    thresholds.push_back(measure_all(measured, f, population));
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
std::optional<std::vector<Thresholds>> values_of(const Member& member, const RunFile& run,
                                                 const Analysis& stored) {
  std::vector<Thresholds> values;
  for (const ChainAnalysis& analysis : chain_analyses(member.scenario.bed.depth)) {
    std::optional<Thresholds> found = Thresholds();
    if (analysis.settings.empty())
      found = measure_thresholds(run, stored, analysis.population);
    else if (has_readings(member))
      found = kept_reading(run, member.path, analysis);
    if (!found) return std::nullopt;
    values.push_back(std::move(*found));
  }
  return values;
}

ReproducedOutcome measure_member(const ReproductionPlan& plan, std::size_t m) {
  const Member& member = plan.members[m];
  const RunFile run = RunFile::open(member.path);
  const auto stored = stored_analysis(run, member.path);
  auto values = stored ? values_of(member, run, *stored) : std::nullopt;
  const std::string numbers = numbers_path(member.path);
  if (!values)
    throw Error(ExitCode::bad_data, member.path + " lacks analyses of this version of Talus; remove " +
                                        numbers + ", and the member is analysed again");
  const MemberNumbers found = read_numbers(member);
  const RunStatics& statics = run.header().statics;
  return {m, found.version, found.seconds, std::move(*values),
          wall_point({run.frame_tilts(), statics.mean_diameter, *stored}, statics.length)};
}

}  // namespace

void make_readings(const Member& member) {
  if (!has_readings(member)) return;
  const RunFile run = RunFile::open(member.path);
  for (const ChainAnalysis& analysis : chain_analyses(member.scenario.bed.depth)) {
    if (analysis.settings.empty() || kept_reading(run, member.path, analysis)) continue;
    const Analysis found = analyse_run(run, parse_analysis_settings(analysis.settings), 1, {});
    const std::string file = reading_path(member.path, analysis);
    prepare_folder_of(file);
    write_text(file, measured_text(found.key, measure_thresholds(run, found, Population::carrying)));
  }
}

bool is_measured(const Member& member) {
  if (run_presence(member.path) != RunPresence::packed) return false;
  const RunFile run = RunFile::open(member.path);
  const auto stored = stored_analysis(run, member.path);
  return stored && values_of(member, run, *stored);
}

ReproductionResult measure_members(const ReproductionPlan& plan) {
  ReproductionResult result{plan, {}};
  for (const std::size_t m : done_members(plan)) result.outcomes.push_back(measure_member(plan, m));
  return result;
}

}  // namespace talus
