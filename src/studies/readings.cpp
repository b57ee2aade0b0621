#include "studies/readings.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>

#include "scenario/text.h"

namespace talus::studies {
namespace {

// Indices into the list of analyses, of grains with their first neighbours and of single grains.
enum : std::size_t {
  stored,
  single,
  single_held,
  single_averaged,
  single_neighbours,
  single_together,
  single_cut,
  single_long_lengths,
  single_long_and_neighbours,
  averaged,
  neighbours,
  cut,
  wider,
  of_all
};

std::vector<Reading> make_readings() {
  std::vector<Reading> all;
  const auto add = [&](std::string_view base, std::size_t factor, std::string_view change,
                       std::size_t analysis) {
    all.push_back({std::string(base), std::string(change), analysis, factor});
  };
  const std::string_view of_single_grains[] = {"single grains, gamma >= Gamma_c",
                                               "single grains, gamma >= 2 Gamma_c"};
  for (std::size_t f = 0; f < std::size(of_single_grains); ++f) {
    const std::string_view base = of_single_grains[f];
    add(base, f, "", single);
    add(base, f, "grains with 3 contacts or more", single_held);
    add(base, f, "moments averaged over 1 deg", single_averaged);
    add(base, f, "neighbours joined", single_neighbours);
    add(base, f, "3 contacts, averaged and neighbours", single_together);
    add(base, f, "l_c cut as in the paper", single_cut);
    if (f == 0) continue;  // l_c ends at Gamma_c already
    add(base, f, "l_c ends at Gamma_c", single_long_lengths);
    add(base, f, "l_c ends at Gamma_c, neighbours joined", single_long_and_neighbours);
  }
  const std::string_view base = "grains with first neighbours, gamma >= Gamma_c";
  add(base, 0, "", stored);
  add(base, 0, "p_o over all grains", of_all);
  add(base, 0, "moments averaged over 1 deg", averaged);
  add(base, 0, "neighbours joined", neighbours);
  add(base, 0, "l_c cut as in the paper", cut);
  add(base, 0, "neighbourhoods of at least 4 D", wider);
  return all;
}

/// Mean score of the results, grouped by one of their members; NaN without results.
std::vector<double> mean_scores(std::span<const ReadingResult> results, std::size_t ReadingResult::*member) {
  std::vector<std::vector<double>> scores;
  for (const ReadingResult& result : results) {
    scores.resize(std::max(scores.size(), result.*member + 1));
    scores[result.*member].push_back(result.agreeing);
  }
  std::vector<double> means;
  for (const std::vector<double>& each : scores) means.push_back(statistics_of(each).mean);
  return means;
}

/// Returns the median; for an even number of values, the mean of the two middle ones.
double median(std::vector<double> values) {
  if (values.empty()) return not_known;
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

double deviation_of(const ReadingResult& result) {
  std::vector<double> deviations;
  for (std::size_t v = 0; v < result.judgements.size(); ++v) {
    const auto& [agreement, difference, tolerance, reason] = result.judgements[v];
    if (agreement == Agreement::absent)
      deviations.push_back(std::numeric_limits<double>::infinity());
    else if (agreement != Agreement::not_comparable)
      deviations.push_back(std::abs(difference / chain_values()[v].value));
  }
  return median(std::move(deviations));
}

/// Whether the first result is closer to the paper.
bool is_nearer(const ReadingResult& first, const ReadingResult& second) {
  if (first.agreeing != second.agreeing) return first.agreeing > second.agreeing;
  return first.deviation < second.deviation;
}

/// Lists the values of the chain that all results miss, with the nearest result.
std::optional<ChainConclusion::MissedValue> missed(std::span<const ReadingResult> results,
                                                   std::size_t value) {
  ChainConclusion::MissedValue found{value, {}};
  double least = 0.0;
  bool comparable = false;
  for (std::size_t r = 0; r < results.size(); ++r) {
    const Judgement& judgement = results[r].judgements[value];
    if (judgement.agreement == Agreement::agrees) return {};
    if (judgement.agreement == Agreement::not_comparable) continue;
    comparable = true;
    if (judgement.agreement == Agreement::absent) continue;
    const double distance = std::abs(judgement.difference);
    if (found.nearest && distance >= least) continue;
    found.nearest = r;
    least = distance;
  }
  if (!comparable) return {};
  return found;
}

}  // namespace

std::vector<ChainAnalysis> chain_analyses(double depth) {
  const std::string paper_cut = "lc_cut=" + scenario::short_text(paper_lc_cut / paper_depth * depth);
  const std::vector<std::vector<std::string>> all = {
      {},
      {"l_min=0"},
      {"l_min=0", "min_contacts=3"},
      {"l_min=0", "averaging=1"},
      {"l_min=0", "joining=neighbours"},
      {"l_min=0", "min_contacts=3", "averaging=1", "joining=neighbours"},
      {"l_min=0", paper_cut},
      {"l_min=0", "lc_factor=1"},
      {"l_min=0", "lc_factor=1", "joining=neighbours"},
      {"averaging=1"},
      {"joining=neighbours"},
      {paper_cut},
      {"l_min=4"},
  };
  std::vector<ChainAnalysis> analyses;
  for (const std::vector<std::string>& settings : all) {
    std::string name = settings.empty() ? "stored" : "";
    for (const std::string& setting : settings) name += (name.empty() ? "" : ",") + setting;
    analyses.push_back({name, settings});
  }
  analyses.push_back({"stored; p_o over all grains", {}, Population::all});
  return analyses;
}

std::span<const Reading> base_readings() {
  static const std::vector<Reading> bases = [] {
    std::vector<Reading> unchanged;
    std::ranges::copy_if(readings(), std::back_inserter(unchanged),
                         [](const Reading& reading) { return reading.change.empty(); });
    return unchanged;
  }();
  return bases;
}

std::span<const Reading> readings() {
  static const std::vector<Reading> all = make_readings();
  return all;
}

ReadingResult judge_reading(std::size_t preparation, std::size_t reading,
                            std::span<const MeasuredValues> runs, double depth) {
  ReadingResult result{preparation, reading, {}, {}, 0, 0, 0.0};
  for (const PaperValue& paper : chain_values()) {
    std::vector<MeasuredValue> values;
    for (const MeasuredValues& run : runs) values.push_back(at(run, paper.quantity));
    result.values.push_back(spread_of(values));
    result.judgements.push_back(judge(paper, result.values.back(), depth));
    const Agreement agreement = result.judgements.back().agreement;
    result.agreeing += agreement == Agreement::agrees ? 1 : 0;
    result.comparable += agreement != Agreement::not_comparable ? 1 : 0;
  }
  result.deviation = deviation_of(result);
  return result;
}

ChainConclusion conclude(std::span<const ReadingResult> results) {
  ChainConclusion conclusion;
  for (std::size_t r = 0; r < results.size(); ++r) {
    const ReadingResult& result = results[r];
    if (!conclusion.best.empty() && is_nearer(result, results[conclusion.best.front()]))
      conclusion.best.clear();
    if (conclusion.best.empty() || !is_nearer(results[conclusion.best.front()], result))
      conclusion.best.push_back(r);
    const auto& least = conclusion.smallest_deviation;
    if (!std::isnan(result.deviation) && (!least || result.deviation < results[*least].deviation))
      conclusion.smallest_deviation = r;
  }
  for (const std::size_t r : conclusion.best)
    conclusion.complete =
        conclusion.complete || (results[r].agreeing > 0 && results[r].agreeing == results[r].comparable);
  for (std::size_t v = 0; v < chain_values().size(); ++v)
    if (const auto found = missed(results, v)) conclusion.missed.push_back(*found);
  conclusion.score_of_reading = mean_scores(results, &ReadingResult::reading);
  conclusion.score_of_preparation = mean_scores(results, &ReadingResult::preparation);
  return conclusion;
}

}  // namespace talus::studies
