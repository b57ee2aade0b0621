#pragma once
/// The analyses that a reproduction needs, and what they give: all that is there and valid is kept.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "ensemble/pool.h"
#include "ensemble/reproduction.h"

namespace talus {

/// `talus analyze` with the default parameters, of each complete run whose stored analysis is not valid.
std::vector<Job> missing_analyses(const ReproductionPlan& plan);

/// How the analyses that no run file stores are made.
struct ValueOptions {
  std::string folder;  ///< their values are kept in FOLDER/study
  int threads = 1;
  std::function<void()> keep_on;  ///< called now and then; throws where it is to stop
  /// Called with the number of analyses that have been made, and of those that had to be.
  std::function<void(std::size_t done, std::size_t all)> show;
};

/// Reads what the complete runs give; their analyses are stored. Makes the other analyses of periodic beds
/// that are not there yet.
ReproductionResult measure_runs(const ReproductionPlan& plan, const ValueOptions& options);

}  // namespace talus
