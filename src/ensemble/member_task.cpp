#include "ensemble/member_task.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "analysis/failure/transition.h"
#include "base/errors.h"
#include "base/hash.h"
#include "base/text.h"
#include "io/packed_file.h"
#include "runs/analysis_parameters.h"
#include "scenario/text.h"

namespace talus::ensemble {

constexpr const char* readings_word = "readings";
constexpr const char* trials_word = "trials ";

/// Parses a plan_text; no value for any other text.
static std::optional<TrialsTask> parse_plan(const std::string& text) {
  std::istringstream words = text_stream(text);
  std::string option, first, every, patch;
  words >> option >> first >> option >> every >> option >> patch;
  const std::optional<SurfacePatch> found = parse_patch(patch);
  const auto angle = parse_number<double>(first), interval = parse_number<double>(every);
  if (!found || !angle || !interval) return std::nullopt;
  const TrialsTask trials{*angle, *interval, *found};
  const bool in_range = trials.first >= 0.0 && trials.first <= TrialsTask::highest &&
                        trials.every >= TrialsTask::min_every && trials.every <= TrialsTask::highest;
  return in_range && plan_text(trials) == text ? std::optional(trials) : std::nullopt;
}

std::string patch_text(const SurfacePatch& patch) {
  return fmt::format("{}x{}", scenario::short_text(patch.width), scenario::short_text(patch.depth));
}

std::optional<SurfacePatch> parse_patch(const std::string& text) {
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos) return std::nullopt;
  const SurfacePatch patch{parse_number<double>(text.substr(0, cross)).value_or(0.0),
                           parse_number<double>(text.substr(cross + 1)).value_or(0.0)};
  const bool usable = patch.width > 0.0 && patch.width < 1e6 && patch.depth > 0.0 && patch.depth < 1e6;
  return usable ? std::optional(patch) : std::nullopt;
}

std::string plan_text(const TrialsTask& trials) {
  return fmt::format("--from {} --every {} --patch {}", scenario::short_text(trials.first),
                     scenario::short_text(trials.every), patch_text(trials.patch));
}

std::string task_text(const MemberTask& task) {
  if (const auto* trials = std::get_if<TrialsTask>(&task)) return trials_word + plan_text(*trials);
  return std::holds_alternative<ReadingsTask>(task) ? readings_word : "";
}

MemberTask parse_task(const std::string& text, const std::string& path) {
  if (text.empty()) return PlainTask{};
  if (text == readings_word) return ReadingsTask{};
  if (text.starts_with(trials_word))
    if (const auto trials = parse_plan(text.substr(std::char_traits<char>::length(trials_word))))
      return *trials;
  throw Error(ExitCode::bad_data, "{}: this version of Talus does not know the task '{}' of members", path,
              visible_word(text));
}

namespace {

using analysis::FrameThreshold;
using analysis::NumberOfRun;
using analysis::Place;
using analysis::RunThreshold;

/// Version of the values; another number invalidates stored ones.
constexpr int reading_version = 2;

/// The values of the chain, in the order of talus.paper.CHAIN.
const NumberOfRun chain[] = {
    {&FrameThreshold::overloaded_fraction, Place::start},
    {&FrameThreshold::overloaded_fraction, Place::theta_d},
    {&FrameThreshold::overloaded_fraction, Place::theta_c},
    {&FrameThreshold::overloaded_fraction, Place::percolation},
    {&FrameThreshold::lc_mean, Place::start},
    {&FrameThreshold::lc_mean, Place::theta_d},
    {&FrameThreshold::lc_mean, Place::theta_c},
    {&FrameThreshold::lc_max, Place::start},
    {&FrameThreshold::lc_max, Place::before_theta_d},
    {&FrameThreshold::lc_max, Place::theta_d},
    {&RunThreshold::lc_jump, Place::run},
    {&RunThreshold::percolation, Place::run},
};

/// Whether the number is known only as an upper bound: a cluster spans the bed from the first frame on.
bool is_bound(const analysis::Analysis& found, const NumberOfRun& number, std::size_t f) {
  const bool at_percolation = number.place == Place::percolation ||
                              number.quantity == analysis::QuantityMember(&RunThreshold::percolation);
  return at_percolation && std::isnan(found.thresholds[f].percolation_error) &&
         !std::isnan(analysis::number_at(found, number, f));
}

/// Returns the parameters of each analysis, on top of the defaults, for a bed of this depth (D). The paper
/// cuts l_c at 3/4 of its depth.
std::vector<std::vector<std::string>> settings_of_readings(double depth) {
  const std::string cut = "lc_cut=" + scenario::short_text(0.75 * depth);
  return {
      {"l_min=0"},
      {"l_min=0", "min_contacts=3"},
      {"l_min=0", "averaging=1"},
      {"l_min=0", "joining=neighbours"},
      {"l_min=0", "min_contacts=3", "averaging=1", "joining=neighbours"},
      {"l_min=0", cut},
      {"l_min=0", "lc_factor=1"},
      {"l_min=0", "lc_factor=1", "joining=neighbours"},
      {"averaging=1"},
      {"joining=neighbours"},
      {cut},
      {"l_min=4"},
  };
}

io::StoredReading measure(const io::RunFile& run, const std::vector<std::string>& settings, std::string key,
                          const runs::AnalysisProgress& progress) {
  const analysis::Analysis found =
      runs::analyse_run(run, runs::parse_analysis_settings(settings), 1, progress);
  const bool failed = !std::isnan(found.theta_c);
  io::StoredReading stored{
      joined(settings, ","), std::move(key), analysis::AnalysisParameters().threshold_factors.size(), {}, {}};
  for (std::size_t f = 0; f < stored.thresholds; ++f)
    for (const NumberOfRun& number : chain) {
      const std::string& unit = analysis::quantity_of(number.quantity).unit;
      const double value = failed ? analysis::number_at(found, number, f) : not_known;
      stored.values.push_back(analysis::scaled(unit, value, run.header().statics.mean_diameter));
      stored.at_most.push_back(failed && is_bound(found, number, f) ? 1 : 0);
    }
  return stored;
}

}  // namespace

std::vector<io::StoredReading> make_readings(const Member& member, const io::RunFile& run,
                                             const runs::AnalysisProgress& progress) {
  std::vector<io::StoredReading> readings;
  if (member.scenario.bed.boundary != scenario::BedBoundary::periodic) return readings;
  const std::vector<io::StoredReading> stored = io::read_readings(run);
  for (const std::vector<std::string>& settings : settings_of_readings(member.scenario.bed.depth)) {
    std::string key = fmt::format("{} {}", reading_version,
                                  runs::analysis_key(run, runs::parse_analysis_settings(settings)));
    const auto kept = std::ranges::find(stored, key, &io::StoredReading::key);
    readings.push_back(kept != stored.end() ? *kept : measure(run, settings, std::move(key), progress));
  }
  return readings;
}

void complete_readings(const Member& member) {
  const io::RunFile run = io::RunFile::open(member.path);
  const std::vector<io::StoredReading> readings = make_readings(member, run, {});
  if (!std::ranges::equal(readings, io::read_readings(run), {}, &io::StoredReading::key,
                          &io::StoredReading::key))
    io::store_readings(member.path, readings, hash_text(state_hash(run.checkpoint().world)));
}

}  // namespace talus::ensemble
