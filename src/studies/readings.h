#pragma once
/// Search for the reading of the paper's definitions, and the preparation of the bed, that come nearest to
/// the paper's chain from the overloaded fraction to theta_d, one factor at a time (docs/reproduce.md).

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "studies/agreement.h"
#include "studies/measured_values.h"

namespace talus::studies {

/// Settings of an analysis that is made of each run.
struct ChainAnalysis {
  std::string name;                   ///< "l_min=0,min_contacts=3"
  std::vector<std::string> settings;  ///< "key=value", on top of the defaults; none: the stored analysis
  Population population = Population::carrying;
};
/// Returns the analyses for beds of a depth (D), of which the paper's cut of l_c is 3/4. Their order does not
/// depend on the depth; the first and the last use the analysis stored in the run files.
std::vector<ChainAnalysis> chain_analyses(double depth);

/// One reading of the paper's definitions of overloaded grains and of what follows from them.
struct Reading {
  std::string base;          ///< "single grains, gamma >= Gamma_c"
  std::string change;        ///< the factor that differs from the first reading of this base, or empty
  std::size_t analysis = 0;  ///< index into chain_analyses()
  std::size_t factor = 0;    ///< index of the threshold
};
/// Returns all readings.
std::span<const Reading> readings();
/// Returns the three readings without a change: single grains with the printed threshold and with twice it,
/// and grains with their first neighbours.
std::span<const Reading> base_readings();

/// The chain of one preparation under one reading, with each value over the seeds.
struct ReadingResult {
  std::size_t preparation = 0;
  std::size_t reading = 0;
  std::vector<Spread> values;         ///< values in the order of chain_values()
  std::vector<Judgement> judgements;  ///< verdicts in the same order
  int agreeing = 0;                   ///< values that agree: the score
  int comparable = 0;                 ///< values that can be compared
  /// Median of |ours - paper| / paper over the comparable values, infinite for a value that does not occur;
  /// NaN if nothing can be compared.
  double deviation = 0.0;
};

/// Judges the chain of one preparation under one reading; `runs` holds the values of each seed.
ReadingResult judge_reading(std::size_t preparation, std::size_t reading,
                            std::span<const MeasuredValues> runs, double depth);

/// Conclusions from all results together.
struct ChainConclusion {
  std::vector<std::size_t> best;  ///< results with the highest score; of these, with the smallest deviation
  std::optional<std::size_t> smallest_deviation;  ///< the result with the smallest deviation of all
  bool complete = false;                          ///< a best result agrees in every comparable value
  /// A value of the chain that no result brings within tolerance, and the result that comes nearest, if the
  /// value occurs in any.
  struct MissedValue {
    std::size_t value = 0;
    std::optional<std::size_t> nearest;
  };
  std::vector<MissedValue> missed;
  /// Mean score of each reading over preparations, and of each preparation over readings; NaN without
  /// results.
  std::vector<double> score_of_reading;
  std::vector<double> score_of_preparation;
};
/// Draws the conclusions from the results.
ChainConclusion conclude(std::span<const ReadingResult> results);

}  // namespace talus::studies
