#include "reproduction/threshold_study.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "session/scenario_text.h"

namespace talus {
namespace {

// Indices into the list of analyses.
enum : std::size_t { stored, held, averaged, neighbours, together, cut, long_lengths, long_and_neighbours };

const char* const thresholds[] = {"gamma >= Gamma_c", "gamma >= 2 Gamma_c"};

std::vector<Reading> make_readings() {
  std::vector<Reading> all;
  for (std::size_t f = 0; f < std::size(thresholds); ++f) {
    const auto add = [&](const char* change, std::size_t analysis, Population population) {
      all.push_back({thresholds[f], change, analysis, f, population});
    };
    add("", stored, Population::carrying);
    add("p_o over all grains", stored, Population::all);
    add("grains with 3 contacts or more", held, Population::carrying);
    add("moments averaged over 1 deg", averaged, Population::carrying);
    add("neighbours joined", neighbours, Population::carrying);
    add("3 contacts, averaged and neighbours", together, Population::carrying);
    add("l_c cut as in the paper", cut, Population::carrying);
    if (f == 0) continue;  // l_c ends at Gamma_c already
    add("l_c ends at Gamma_c", long_lengths, Population::carrying);
    add("l_c ends at Gamma_c, neighbours joined", long_and_neighbours, Population::carrying);
  }
  return all;
}

double mean_score(std::span<const ReadingResult> results, std::size_t ReadingResult::*member,
                  std::size_t index) {
  double sum = 0.0;
  int count = 0;
  for (const ReadingResult& result : results)
    if (result.*member == index) {
      sum += result.agreeing;
      ++count;
    }
  return sum / count;  // NaN where there is none
}

std::vector<double> mean_scores(std::span<const ReadingResult> results, std::size_t ReadingResult::*member) {
  std::size_t count = 0;
  for (const ReadingResult& result : results) count = std::max(count, result.*member + 1);
  std::vector<double> scores;
  for (std::size_t k = 0; k < count; ++k) scores.push_back(mean_score(results, member, k));
  return scores;
}

/// The middle of the values; between two, their mean.
double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
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

/// Whether the first is nearer to the paper.
bool is_nearer(const ReadingResult& first, const ReadingResult& second) {
  if (first.agreeing != second.agreeing) return first.agreeing > second.agreeing;
  return first.deviation < second.deviation;
}

/// Where a value of the chain is missed by all results, and which is nearest.
std::optional<StudyConclusion::Missed> missed(std::span<const ReadingResult> results, std::size_t value) {
  StudyConclusion::Missed found{value, {}};
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

std::vector<StudyAnalysis> study_analyses(double depth) {
  const std::string paper_cut = "lc_cut=" + short_text(paper_lc_cut / paper_depth * depth);
  return {
      {"", {}},
      {"min_contacts=3", {"min_contacts=3"}},
      {"averaging=1", {"averaging=1"}},
      {"joining=neighbours", {"joining=neighbours"}},
      {"min_contacts=3,averaging=1,joining=neighbours",
       {"min_contacts=3", "averaging=1", "joining=neighbours"}},
      {paper_cut, {paper_cut}},
      {"lc_factor=1", {"lc_factor=1"}},
      {"lc_factor=1,joining=neighbours", {"lc_factor=1", "joining=neighbours"}},
  };
}

std::span<const Reading> readings() {
  static const std::vector<Reading> all = make_readings();
  return all;
}

ReadingResult judge_reading(std::size_t preparation, std::size_t reading,
                            std::span<const MeasuredValues> runs, double depth) {
  ReadingResult result{preparation, reading, {}, {}, 0, 0, 0.0};
  for (const PaperValue& paper : chain_values()) {
    std::vector<Measured> values;
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

StudyConclusion conclude(std::span<const ReadingResult> results) {
  StudyConclusion conclusion;
  for (std::size_t r = 0; r < results.size(); ++r) {
    const ReadingResult& result = results[r];
    if (!conclusion.best.empty() && is_nearer(result, results[conclusion.best.front()]))
      conclusion.best.clear();
    if (conclusion.best.empty() || !is_nearer(results[conclusion.best.front()], result))
      conclusion.best.push_back(r);
    const auto& least = conclusion.least_deviation;
    if (!std::isnan(result.deviation) && (!least || result.deviation < results[*least].deviation))
      conclusion.least_deviation = r;
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

}  // namespace talus
