#pragma once
/// Which reading of the paper's definitions, and which preparation of the bed, comes nearest to the paper's
/// chain from the overloaded fraction to theta_d: one factor at a time (docs/reproduce.md).

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "studies/agreement.h"
#include "studies/measured_values.h"

namespace talus::studies {

/// An analysis of each run.
struct ChainAnalysis {
  std::string name;                   ///< "l_min=0,min_contacts=3"
  std::vector<std::string> settings;  ///< "key=value" on the defaults; none: that which run files store
  Population population = Population::carrying;
};
/// For beds of a depth (D): the paper's cut of l_c is 3/4 of it. Their order does not depend on it; the first
/// and the last are read from what run files store.
std::vector<ChainAnalysis> chain_analyses(double depth);

/// A way to read the paper's definitions: which grains are overloaded, and what follows from it.
struct Reading {
  std::string base;          ///< "single grains, gamma >= Gamma_c"
  std::string change;        ///< the one factor that differs from the first reading of this base; empty: none
  std::size_t analysis = 0;  ///< index into chain_analyses()
  std::size_t factor = 0;    ///< index of the threshold
};
std::span<const Reading> readings();
/// The three with no change: single grains with the printed threshold and with twice it, and grains with
/// their first neighbours.
std::span<const Reading> base_readings();

/// The chain of one preparation under one reading, each value over the seeds.
struct ReadingResult {
  std::size_t preparation = 0;
  std::size_t reading = 0;
  std::vector<Spread> values;         ///< of chain_values(), in their order
  std::vector<Judgement> judgements;  ///< the same
  int agreeing = 0;                   ///< values that agree: the score
  int comparable = 0;                 ///< values that can be compared
  /// Median over these of |ours - paper| / paper, infinite where a value does not occur: half of the chain is
  /// at least as near. NaN where nothing can be compared.
  double deviation = 0.0;
};

/// `runs`: the values of each seed under the reading.
ReadingResult judge_reading(std::size_t preparation, std::size_t reading,
                            std::span<const MeasuredValues> runs, double depth);

/// What follows from all results together.
struct ChainConclusion {
  std::vector<std::size_t> best;  ///< results with the highest score; of these, with the smallest deviation
  std::optional<std::size_t> least_deviation;  ///< the result with the smallest deviation of all
  bool complete = false;                       ///< a best one agrees in all that can be compared
  /// Of the chain: values that no result brings within tolerance, and the result that comes nearest; none
  /// where it occurs in no result.
  struct Missed {
    std::size_t value = 0;
    std::optional<std::size_t> nearest;
  };
  std::vector<Missed> missed;
  /// Mean score over preparations of each reading, and over readings of each preparation; NaN where there is
  /// no result.
  std::vector<double> score_of_reading;
  std::vector<double> score_of_preparation;
};
ChainConclusion conclude(std::span<const ReadingResult> results);

}  // namespace talus::studies
