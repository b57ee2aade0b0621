#include "ensemble/study.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "core/errors.h"
#include "core/hash.h"
#include "io/run_file.h"
#include "scenario/keys.h"
#include "scenario/text.h"
#include "session/run_header.h"

namespace talus {
namespace {

[[noreturn]] void refuse_axis(const std::string& text) {
  throw Error(
      ExitCode::usage,
      fmt::format("--vary {}: expected KEY=VALUE,VALUE... such as tilt.step=0.002,0.0005; keys that change "
                  "together are joined by colons, as in tilt.rate:tilt.step=2:0.002,0.5:0.0005",
                  printable(text)));
}

std::string key_of(const std::string& setting) { return setting.substr(0, setting.find('=')); }

/// `settings` without those whose keys the variation sets.
std::vector<std::string> kept(std::vector<std::string> settings, const std::vector<std::string>& variation) {
  for (const std::string& change : variation)
    std::erase_if(settings, [&](const std::string& setting) { return key_of(setting) == key_of(change); });
  return settings;
}

/// The values that a scenario has for the keys of a variation. They are not as they were spelled: 1e-6 and
/// 0.000001 are one variation.
std::string name_of(const std::vector<std::string>& variation, const Scenario& scenario) {
  std::string name;
  for (const std::string& setting : variation) {
    const ScenarioKey* key = find_key(key_of(setting));
    if (!name.empty()) name += ",";
    name += fmt::format("{}={}", full_name(*key), plain_text(key->get(scenario)));
  }
  return name;
}

}  // namespace

std::vector<std::vector<std::string>> parse_axis(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) refuse_axis(text);
  const std::vector<std::string> keys = split(text.substr(0, equals), ':');
  std::vector<std::vector<std::string>> variations;
  for (const std::string& item : split(text.substr(equals + 1), ',')) {
    const std::vector<std::string> values = split(item, ':');
    if (values.size() != keys.size()) refuse_axis(text);
    std::vector<std::string> settings;
    for (std::size_t k = 0; k < keys.size(); ++k) {
      if (keys[k].empty() || values[k].empty()) refuse_axis(text);
      settings.push_back(fmt::format("{}={}", keys[k], values[k]));
    }
    variations.push_back(std::move(settings));
  }
  return variations;
}

StudyPlan plan_study(const std::string& scenario_file, const std::vector<std::string>& settings,
                     const std::vector<std::string>& axes, const std::string& seeds,
                     const std::string& folder) {
  const std::vector<std::uint64_t> all_seeds = parse_seeds(seeds);
  std::vector<Variant> variants;
  std::vector<std::string> varied;
  const auto add = [&](const std::vector<std::string>& variation) {
    std::vector<std::string> all = kept(settings, variation);
    std::vector<std::string> with_seed = all;
    with_seed.push_back(fmt::format("seed={}", all_seeds.front()));
    const Scenario scenario = read_scenario(scenario_file, with_seed, nullptr, variation);
    all.insert(all.end(), variation.begin(), variation.end());
    for (const std::string& setting : variation)
      if (std::ranges::find(varied, key_of(setting)) == varied.end()) varied.push_back(key_of(setting));
    if (std::ranges::find(variants, scenario, &Variant::scenario) != variants.end()) return;
    const std::string name = variation.empty() ? "baseline" : name_of(variation, scenario);
    variants.push_back({name, scenario_file, all, scenario});
  };
  add({});
  for (const std::string& axis : axes)
    for (const std::vector<std::string>& variation : parse_axis(axis)) add(variation);
  const std::string baseline = name_of(varied, variants.front().scenario);
  return {plan_ensemble(all_seeds, std::move(variants), folder), baseline};
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

StudyResult read_study(const StudyPlan& plan, std::optional<double> reference) {
  StudyResult result{plan, 0.0, {}};
  std::vector<RunReach> reaches;
  for (const std::size_t k : complete_members(plan)) {
    const RunFile run = RunFile::open(plan.members[k].path);
    reaches.push_back(reach(run));
    result.outcomes.push_back(
        {k, {}, hash_text(state_hash(run.checkpoint().world)), version_of(run.header().provenance)});
  }
  if (reaches.empty())
    throw Error(ExitCode::bad_data, "no run of the study is complete; nothing can be compared");
  result.reference = reference.value_or(common_angle(reaches));
  for (StudyOutcome& outcome : result.outcomes)
    outcome.figures = study_figures(RunFile::open(plan.members[outcome.member].path), result.reference);
  return result;
}

std::vector<double> values_of(const StudyResult& result, std::size_t variant, StudyQuantity quantity) {
  const auto& seeds = result.plan.seeds;
  std::vector<double> values(seeds.size(), std::numeric_limits<double>::quiet_NaN());
  for (const StudyOutcome& outcome : result.outcomes) {
    const Member& member = result.plan.members[outcome.member];
    if (member.variant != variant) continue;
    const auto seed = std::ranges::lower_bound(seeds, member.seed);
    values[static_cast<std::size_t>(seed - seeds.begin())] = at(outcome.figures, quantity);
  }
  return values;
}

Comparison compare(const StudyResult& result, std::size_t variant, StudyQuantity quantity) {
  const std::vector<double> values = values_of(result, variant, quantity);
  return {statistics_of(values), paired_difference(values, values_of(result, 0, quantity))};
}

}  // namespace talus
