#include "reproduction/result.h"

#include <cmath>

#include "session/scenario_text.h"

namespace talus {
namespace {

/// Calls use(outcome) for each outcome of a bed.
template <typename Use>
void for_each_outcome(const ReproductionResult& result, std::size_t bed, const Use& use) {
  for (const ReproducedOutcome& outcome : result.outcomes)
    if (result.plan.runs[outcome.run].bed == bed) use(outcome);
}

/// A column of text: commas part columns, so they become semicolons.
std::string column(std::string_view text) {
  std::string result;
  for (const char c : text) result += c == ',' ? ';' : c;
  return result;
}

void add_rows(std::string& text, const ReproducedRun& run, const std::string& analysis, std::size_t factor,
              const MeasuredValues& values) {
  for (const PaperValue& paper : paper_values) {
    const Measured& measured = at(values, paper.quantity);
    if (std::isnan(measured.value)) continue;
    text += run.name + "," + std::to_string(run.seed) + "," + column(analysis) + "," +
            std::to_string(factor + 1) + ",";
    text.append(column(paper.name)).append(",").append(paper.unit).append(",");
    text += short_text(measured.value) + "," + (measured.at_most ? "1" : "0") + "\n";
  }
}

}  // namespace

Spread spread_of(const ReproductionResult& result, std::size_t bed, PaperQuantity quantity) {
  return spread_of(result, bed, quantity, {"", "", 0, 0, Population::carrying});
}

Spread spread_of(const ReproductionResult& result, std::size_t bed, PaperQuantity quantity,
                 const Reading& reading) {
  std::vector<Measured> values;
  for_each_outcome(result, bed, [&](const ReproducedOutcome& outcome) {
    values.push_back(at(outcome.values[reading.analysis][reading.factor], quantity));
  });
  return spread_of(values);
}

std::vector<ReadingResult> study_of(const ReproductionResult& result) {
  std::vector<ReadingResult> results;
  for (std::size_t b = 0; b < result.plan.beds.size(); ++b) {
    const ReproducedBed& bed = result.plan.beds[b];
    if (!bed.periodic()) continue;
    for (std::size_t r = 0; r < readings().size(); ++r) {
      const Reading& reading = readings()[r];
      std::vector<MeasuredValues> runs;
      for_each_outcome(result, b, [&](const ReproducedOutcome& outcome) {
        runs.push_back(reading.population == Population::all
                           ? outcome.values_of_all[reading.factor]
                           : outcome.values[reading.analysis][reading.factor]);
      });
      if (!runs.empty()) results.push_back(judge_reading(b, r, runs, bed.scenario.bed.depth));
    }
  }
  return results;
}

std::vector<WallPoint> wall_points(const ReproductionResult& result) {
  std::vector<WallPoint> points;
  for (std::size_t b = 0; b < result.plan.beds.size(); ++b)
    if (!result.plan.beds[b].periodic())
      for_each_outcome(result, b, [&](const ReproducedOutcome& outcome) {
        if (!std::isnan(outcome.wall.ratio)) points.push_back(outcome.wall);
      });
  return points;
}

std::string values_csv(const ReproductionResult& result) {
  std::string text = "run,seed,analysis,threshold_over_gamma_c,quantity,unit,value,at_most\n";
  for (const ReproducedOutcome& outcome : result.outcomes) {
    const ReproducedRun& run = result.plan.runs[outcome.run];
    const std::vector<StudyAnalysis> analyses = study_analyses(run.scenario.bed.depth);
    for (std::size_t a = 0; a < outcome.values.size(); ++a)
      for (std::size_t f = 0; f < outcome.values[a].size(); ++f)
        add_rows(text, run, a > 0 ? analyses[a].name : "stored", f, outcome.values[a][f]);
    for (std::size_t f = 0; f < outcome.values_of_all.size(); ++f)
      add_rows(text, run, "stored; p_o over all grains", f, outcome.values_of_all[f]);
  }
  return text;
}

}  // namespace talus
