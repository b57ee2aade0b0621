#include "studies/reproduction_values.h"

#include <algorithm>
#include <fmt/core.h>
#include <optional>
#include <utility>

#include "base/errors.h"
#include "base/hash.h"
#include "ensemble/member_state.h"
#include "ensemble/member_values.h"
#include "io/analysis_file.h"
#include "io/run_file.h"
#include "runs/analysis_parameters.h"
#include "runs/analysis_run.h"

namespace talus::studies {
namespace {

/// The values of a member by one analysis, one entry for each threshold.
using Thresholds = std::vector<MeasuredValues>;

/// Returns the run of a member with its stored analysis; empty unless that has the default parameters.
std::optional<runs::RunView> stored_run(const std::string& path) {
  io::RunFile file = io::RunFile::open(path);
  std::optional<analysis::Analysis> stored = io::read_analysis(path);
  if (!stored || stored->key != runs::analysis_key(file, analysis::AnalysisParameters())) return std::nullopt;
  return runs::view_of_run(path, std::move(file), std::move(*stored));
}

Thresholds measure_thresholds(const runs::RunView& run, Population population) {
  Thresholds thresholds;
  for (std::size_t f = 0; f < analysis::AnalysisParameters().threshold_factors.size(); ++f)
    thresholds.push_back(measure_all(run, f, population));
  return thresholds;
}

/// Version of the definitions; a new number invalidates stored values.
constexpr int measure_version = 1;

std::string reading_key(const io::RunFile& run, const ChainAnalysis& analysis) {
  return fmt::format("{} {}", measure_version,
                     runs::analysis_key(run, runs::parse_analysis_settings(analysis.settings)));
}

io::StoredReading stored_reading(const ChainAnalysis& analysis, std::string key,
                                 const Thresholds& thresholds) {
  io::StoredReading stored{analysis.name, std::move(key), thresholds.size(), {}, {}};
  for (const MeasuredValues& values : thresholds)
    for (const auto& [value, at_most] : values) {
      stored.values.push_back(value);
      stored.at_most.push_back(at_most ? 1 : 0);
    }
  return stored;
}

Thresholds thresholds_of(const io::StoredReading& stored) {
  Thresholds thresholds(stored.thresholds);
  for (std::size_t k = 0; k < stored.values.size(); ++k)
    thresholds[k / quantity_count][k % quantity_count] = {stored.values[k], stored.at_most[k] != 0};
  return thresholds;
}

/// Whether the bed is analysed for the readings; beds between walls are not.
bool has_readings(const ensemble::Member& member) {
  return member.scenario.bed.boundary == scenario::BedBoundary::periodic;
}

/// Returns the stored reading of an analysis if it exists and is valid.
const io::StoredReading* kept_reading(const io::RunFile& run, const std::vector<io::StoredReading>& stored,
                                      const ChainAnalysis& analysis) {
  const auto found = std::ranges::find(stored, analysis.name, &io::StoredReading::name);
  const bool is_valid = found != stored.end() && found->key == reading_key(run, analysis) &&
                        found->values.size() == found->thresholds * quantity_count;
  return is_valid ? &*found : nullptr;
}

/// Returns the values of a member by each analysis, in the order of chain_analyses() (for beds between walls
/// only that of the run file, the others are empty); empty if one is missing.
std::optional<std::vector<Thresholds>> values_of(const ensemble::Member& member, const runs::RunView& run) {
  std::vector<Thresholds> values;
  const std::vector<io::StoredReading> stored = io::read_readings(*run.file);
  for (const ChainAnalysis& analysis : chain_analyses(member.scenario.bed.depth)) {
    Thresholds found;
    if (analysis.settings.empty()) {
      found = measure_thresholds(run, analysis.population);
    } else if (has_readings(member)) {
      const io::StoredReading* const kept = kept_reading(*run.file, stored, analysis);
      if (kept == nullptr) return std::nullopt;
      found = thresholds_of(*kept);
    }
    values.push_back(std::move(found));
  }
  return values;
}

ReproducedOutcome measure_member(const ReproductionPlan& plan, std::size_t m) {
  const ensemble::Member& member = plan.members[m];
  const std::optional<runs::RunView> run = stored_run(member.path);
  auto values = run ? values_of(member, *run) : std::nullopt;
  if (!values)
    throw Error(ExitCode::bad_data, member.path +
                                        " lacks analyses of this version of Talus, and they could not be "
                                        "stored; make the folder writable");
  const ensemble::MemberNumbers found = ensemble::member_numbers(*run->file, run->analysis);
  return {m, found.version, found.seconds, std::move(*values), wall_point(*run)};
}

}  // namespace

std::vector<io::StoredReading> make_readings(const ensemble::Member& member, const io::RunFile& file,
                                             const runs::AnalysisProgress& progress) {
  std::vector<io::StoredReading> readings;
  if (!has_readings(member)) return readings;
  const std::vector<io::StoredReading> stored = io::read_readings(file);
  for (const ChainAnalysis& analysis : chain_analyses(member.scenario.bed.depth)) {
    if (analysis.settings.empty()) continue;
    if (const io::StoredReading* const kept = kept_reading(file, stored, analysis)) {
      readings.push_back(*kept);
      continue;
    }
    runs::RunView run;
    run.statics = file.header().statics;
    run.analysis = runs::analyse_run(file, runs::parse_analysis_settings(analysis.settings), 1, progress);
    readings.push_back(
        stored_reading(analysis, reading_key(file, analysis), measure_thresholds(run, Population::carrying)));
  }
  return readings;
}

void complete_readings(const ensemble::Member& member) {
  const io::RunFile run = io::RunFile::open(member.path);
  const std::vector<io::StoredReading> readings = make_readings(member, run, {});
  if (!std::ranges::equal(readings, io::read_readings(run), {}, &io::StoredReading::key,
                          &io::StoredReading::key))
    io::store_readings(member.path, readings, hash_text(state_hash(run.checkpoint().world)));
}

bool is_measured(const ensemble::Member& member) {
  if (io::run_presence(member.path) != io::RunPresence::packed) return false;
  const std::optional<runs::RunView> run = stored_run(member.path);
  return run && values_of(member, *run);
}

ReproductionResult measure_members(const ReproductionPlan& plan) {
  ReproductionResult result{plan, {}};
  for (const std::size_t m : ensemble::done_members(plan)) result.outcomes.push_back(measure_member(plan, m));
  return result;
}

}  // namespace talus::studies
