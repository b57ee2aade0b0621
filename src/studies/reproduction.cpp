#include "studies/reproduction.h"

#include <cmath>
#include <fmt/core.h>

#include "scenario/text.h"
#include "studies/built_in_scenarios.h"

namespace talus::studies {
namespace {

constexpr std::string_view preparations[] = {"pour", "geometric", "collapse"};  // deposition.method
constexpr int wall_lengths[] = {100, 150, 200, 250, 300};
constexpr double quick_scale = 0.5;  // factor of lengths and depths

std::string setting(const char* key, double value) {
  return fmt::format("{}={}", key, scenario::short_text(value));
}

/// Returns a bed of the paper.
ensemble::Variant make_bed(bool quick, std::string name, const std::string& scenario_name,
                           std::vector<std::string> settings) {
  const std::string text(built_in_scenario(scenario_name)), file = scenario_name + ".toml";
  if (quick) {
    const scenario::Scenario full = scenario::parse_scenario(text, file);
    settings.push_back(setting("bed.length", quick_scale * full.bed.length));
    settings.push_back(setting("bed.depth", quick_scale * full.bed.depth));
  }
  return {std::move(name), file, scenario::parse_scenario(text, file, settings)};
}

std::vector<ensemble::Variant> make_beds(bool quick) {
  std::vector<ensemble::Variant> beds;
  for (const std::string_view method : preparations) {
    std::string name = "pbc";
    std::vector<std::string> settings;
    if (method != preparations[0]) {
      name += fmt::format("-{}", method);
      settings.push_back(fmt::format("deposition.method={}", method));
    }
    beds.push_back(make_bed(quick, std::move(name), "paper-pbc", std::move(settings)));
  }
  for (const int length : wall_lengths)
    beds.push_back(make_bed(quick, "wbc-" + scenario::short_text((quick ? quick_scale : 1.0) * length),
                            fmt::format("paper-wbc-{}", length), {}));
  return beds;
}

/// Returns a text column with commas, which separate columns, replaced by semicolons.
std::string column(std::string_view text) {
  std::string result;
  for (const char c : text) result += c == ',' ? ';' : c;
  return result;
}

void add_rows(std::string& text, const ensemble::Member& run, const std::string& analysis, std::size_t factor,
              const MeasuredValues& values) {
  for (const PaperValue& paper : paper_values) {
    const MeasuredValue& measured = at(values, paper.quantity);
    if (std::isnan(measured.value)) continue;
    text +=
        fmt::format("{},{},{},{},{},{},{},{:d}\n", run.name, run.seed, column(analysis), factor + 1,
                    column(paper.name), paper.unit, scenario::short_text(measured.value), measured.at_most);
  }
}

}  // namespace

ReproductionPlan plan_reproduction(bool quick, const std::string& seeds, const std::string& folder) {
  return {ensemble::plan_ensemble(ensemble::parse_seeds(seeds), make_beds(quick), folder), quick};
}

bool is_periodic(const ensemble::Variant& bed) {
  return bed.scenario.bed.boundary == scenario::BedBoundary::periodic;
}

double depth_over_length(const ensemble::Variant& bed) {
  return bed.scenario.bed.depth / bed.scenario.bed.length;
}

std::vector<const ReproducedOutcome*> outcomes_of(const ReproductionResult& result, std::size_t bed) {
  std::vector<const ReproducedOutcome*> outcomes;
  for (const ReproducedOutcome& outcome : result.outcomes)
    if (result.plan.members[outcome.member].variant == bed) outcomes.push_back(&outcome);
  return outcomes;
}

Spread spread_of(const ReproductionResult& result, std::size_t bed, PaperQuantity quantity,
                 const Reading& reading) {
  std::vector<MeasuredValue> values;
  for (const ReproducedOutcome* outcome : outcomes_of(result, bed))
    values.push_back(at(outcome->values[reading.analysis][reading.factor], quantity));
  return spread_of(values);
}

std::vector<ReadingResult> chain_results(const ReproductionResult& result) {
  std::vector<ReadingResult> results;
  for (std::size_t b = 0; b < result.plan.variants.size(); ++b) {
    const ensemble::Variant& bed = result.plan.variants[b];
    const std::vector<const ReproducedOutcome*> outcomes = outcomes_of(result, b);
    if (!is_periodic(bed) || outcomes.empty()) continue;
    for (std::size_t r = 0; r < readings().size(); ++r) {
      std::vector<MeasuredValues> runs;
      for (const ReproducedOutcome* outcome : outcomes)
        runs.push_back(outcome->values[readings()[r].analysis][readings()[r].factor]);
      results.push_back(judge_reading(b, r, runs, bed.scenario.bed.depth));
    }
  }
  return results;
}

std::vector<WallPoint> wall_points(const ReproductionResult& result) {
  std::vector<WallPoint> points;
  for (std::size_t b = 0; b < result.plan.variants.size(); ++b)
    for (const ReproducedOutcome* outcome : outcomes_of(result, b))
      if (!is_periodic(result.plan.variants[b]) && !std::isnan(outcome->wall.ratio))
        points.push_back(outcome->wall);
  return points;
}

std::string values_csv(const ReproductionResult& result) {
  std::string text = "run,seed,analysis,threshold_over_gamma_c,quantity,unit,value,at_most\n";
  for (const ReproducedOutcome& outcome : result.outcomes) {
    const ensemble::Member& run = result.plan.members[outcome.member];
    const std::vector<ChainAnalysis> analyses = chain_analyses(run.scenario.bed.depth);
    for (std::size_t a = 0; a < outcome.values.size(); ++a)
      for (std::size_t f = 0; f < outcome.values[a].size(); ++f)
        add_rows(text, run, analyses[a].name, f, outcome.values[a][f]);
  }
  return text;
}

}  // namespace talus::studies
