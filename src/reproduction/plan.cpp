#include "reproduction/plan.h"

#include <algorithm>

#include "reproduction/built_in_scenarios.h"
#include "session/estimate.h"
#include "session/scenario_text.h"
#include "session/study.h"

namespace talus {
namespace {

constexpr std::string_view preparations[] = {"pour", "geometric", "collapse"};  // deposition.method
constexpr int wall_lengths[] = {100, 150, 200, 250, 300};
constexpr double quick_scale = 0.5;  // of lengths and depths

std::string setting(const char* key, double value) {
  return std::string(key).append("=").append(short_text(value));
}

ReproducedBed make_bed(std::string name, std::string scenario_name, std::vector<std::string> settings,
                       bool quick) {
  const std::string text(built_in_scenario(scenario_name));
  const std::string file = scenario_name + ".toml";
  if (quick) {
    const Scenario full = parse_scenario(text, file);
    settings.push_back(setting("bed.length", quick_scale * full.bed.length));
    settings.push_back(setting("bed.depth", quick_scale * full.bed.depth));
  }
  const Scenario scenario = parse_scenario(text, file, settings);
  return {std::move(name), std::move(scenario_name), std::move(settings), scenario};
}

std::vector<ReproducedBed> make_beds(bool quick) {
  std::vector<ReproducedBed> beds;
  for (const std::string_view method : preparations) {
    std::string name = "pbc";
    std::vector<std::string> settings;
    if (method != preparations[0]) {
      name.append("-").append(method);
      settings.push_back(std::string("deposition.method=").append(method));
    }
    beds.push_back(make_bed(std::move(name), "paper-pbc", std::move(settings), quick));
  }
  for (const int length : wall_lengths)
    beds.push_back(make_bed("wbc-" + short_text((quick ? quick_scale : 1.0) * length),
                            "paper-wbc-" + std::to_string(length), {}, quick));
  return beds;
}

}  // namespace

ReproductionPlan plan_reproduction(bool quick, const std::string& seeds) {
  ReproductionPlan plan;
  plan.quick = quick;
  plan.seeds = parse_seeds(seeds);
  plan.beds = make_beds(quick);
  std::vector<std::size_t> order(plan.beds.size());
  for (std::size_t b = 0; b < order.size(); ++b) order[b] = b;
  std::ranges::stable_sort(order, {}, [&](std::size_t b) { return estimate(plan.beds[b].scenario).seconds; });
  for (const std::uint64_t seed : plan.seeds)
    for (const std::size_t b : order) {
      ReproducedRun run{b, seed, plan.beds[b].name + "/seed-" + std::to_string(seed), plan.beds[b].scenario};
      run.scenario.seed = seed;
      plan.runs.push_back(std::move(run));
    }
  return plan;
}

std::vector<std::size_t> runs_of(const ReproductionPlan& plan, std::size_t bed) {
  std::vector<std::size_t> runs;
  for (std::size_t r = 0; r < plan.runs.size(); ++r)
    if (plan.runs[r].bed == bed) runs.push_back(r);
  return runs;
}

}  // namespace talus
