#include "ensemble/study.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "core/errors.h"
#include "core/hash.h"
#include "ensemble/axes.h"
#include "io/run_file.h"
#include "scenario/keys.h"
#include "scenario/text.h"
#include "session/run_header.h"

namespace talus {

StudyPlan plan_study(const std::string& scenario_file, const std::vector<std::string>& settings,
                     const std::vector<std::string>& axes, const std::string& seeds,
                     const std::string& folder) {
  const std::vector<std::uint64_t> all_seeds = parse_seeds(seeds);
  std::vector<Variant> variants;
  std::vector<std::string> varied;
  const auto add = [&](const std::vector<std::string>& variation) {
    std::vector<std::string> all = settings_without(settings, variation);
    std::vector<std::string> with_seed = all;
    with_seed.push_back(fmt::format("seed={}", all_seeds.front()));
    const Scenario scenario = read_scenario(scenario_file, with_seed, nullptr, variation);
    all.insert(all.end(), variation.begin(), variation.end());
    for (const std::string& setting : variation)
      if (std::ranges::find(varied, key_of_setting(setting)) == varied.end())
        varied.push_back(key_of_setting(setting));
    if (std::ranges::find(variants, scenario, &Variant::scenario) != variants.end()) return;
    const std::string name = variation.empty() ? "baseline" : variation_name(variation, scenario);
    variants.push_back({name, scenario_file, all, scenario});
  };
  add({});
  for (const std::string& axis : axes)
    for (const std::vector<std::string>& variation : parse_axis(axis)) add(variation);
  const std::string baseline = variation_name(varied, variants.front().scenario);
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
