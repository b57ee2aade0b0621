#include "studies/study.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.h"
#include "ensemble/axes.h"
#include "ensemble/ensemble_manifest.h"
#include "ensemble/member_reader.h"
#include "ensemble/member_state.h"
#include "ensemble/until.h"
#include "io/run_file.h"

namespace talus::studies {

StudyPlan plan_study(const std::string& scenario_file, const std::vector<std::string>& settings,
                     const std::vector<std::string>& axes, const std::string& seeds,
                     const std::string& folder) {
  std::vector<ensemble::Variant> variants = ensemble::plan_variants(scenario_file, settings, {});
  variants.front().name = "baseline";
  std::vector<std::string> varied;
  for (const std::string& axis : axes) {
    for (const std::vector<std::string>& variation : ensemble::parse_axis(axis))
      for (const std::string& setting : variation)
        if (std::ranges::find(varied, ensemble::key_of_setting(setting)) == varied.end())
          varied.push_back(ensemble::key_of_setting(setting));
    for (ensemble::Variant& variant : ensemble::plan_variants(scenario_file, settings, {axis}))
      if (std::ranges::find(variants, variant.scenario, &ensemble::Variant::scenario) == variants.end())
        variants.push_back(std::move(variant));
  }
  ensemble::take_earlier_names(variants, folder);
  const std::string baseline = ensemble::variation_name(varied, variants.front().scenario);
  return {ensemble::plan_ensemble(ensemble::parse_seeds(seeds), std::move(variants), folder), scenario_file,
          baseline};
}

double common_angle(const std::vector<RunReach>& reaches) {
  double lowest_failure = std::numeric_limits<double>::infinity();
  double lowest_end = lowest_failure;
  for (const RunReach& reached : reaches) {
    double& lowest = std::isnan(reached.theta_c) ? lowest_end : lowest_failure;
    lowest = std::min(lowest, std::isnan(reached.theta_c) ? reached.end : reached.theta_c);
  }
  // A tilt is a sum in radians, so that 3 deg may read 3.0000000000000004.
  return std::min(std::floor(lowest_failure), std::round(1e6 * lowest_end) / 1e6);
}

StudyResult read_study(const StudyPlan& plan, std::optional<double> reference) {
  StudyResult result{plan, 0.0, {}};
  std::vector<RunReach> reaches;
  const std::vector<ensemble::MemberState> states = ensemble::scan_members(plan);
  ensemble::KnownMembers known;
  const std::vector<ensemble::MemberNumbers> numbers = ensemble::numbers_of(plan, states, known);
  for (std::size_t m = 0; m < plan.members.size(); ++m) {
    if (states[m].stage != ensemble::MemberStage::done) continue;
    reaches.push_back(reach(io::RunFile::open(plan.members[m].path)));
    result.outcomes.push_back({m, {}, numbers[m].state_hash, numbers[m].version});
  }
  if (reaches.empty())
    throw Error(ExitCode::bad_data, "no run of the study is complete; nothing can be compared");
  result.reference = reference.value_or(common_angle(reaches));
  for (StudyOutcome& outcome : result.outcomes) {
    const ensemble::Member& member = plan.members[outcome.member];
    outcome.figures = study_figures(io::RunFile::open(member.path), ensemble::analysed_member(member, known),
                                    result.reference);
  }
  return result;
}

std::vector<double> values_of(const StudyResult& result, std::size_t variant, StudyQuantity quantity) {
  const auto& seeds = result.plan.seeds;
  std::vector<double> values(seeds.size(), not_known);
  for (const StudyOutcome& outcome : result.outcomes) {
    const ensemble::Member& member = result.plan.members[outcome.member];
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

}  // namespace talus::studies
