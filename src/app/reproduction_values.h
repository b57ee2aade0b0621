#pragma once
/// The analyses that `talus reproduce` needs, and what they give: all that is there and valid is kept.

#include <csignal>
#include <string>

#include "reproduction/result.h"

namespace talus {

/// How a command goes on with its work.
struct WorkOptions {
  std::string folder;
  int jobs = 1;
  const volatile std::sig_atomic_t* stop = nullptr;  ///< set by a signal
};

/// Throws Error(stopped) where a signal has asked to stop.
void stop_where_asked(const WorkOptions& options);

/// The file of a run of the plan.
std::string run_path(const WorkOptions& options, const ReproducedRun& run);

/// Analyses the complete runs with the default parameters, each by `talus analyze`, side by side. Those
/// whose stored analysis is valid are left as they are. Throws Error(stopped), and the Error of analyses that
/// ended with one.
void analyse_missing(const ReproductionPlan& plan, const WorkOptions& options);

/// Reads what the complete runs give, and makes the analyses of the study, which no run file stores: their
/// values are kept in FOLDER/study. Throws Error(stopped).
ReproductionResult measure_runs(const ReproductionPlan& plan, const WorkOptions& options);

}  // namespace talus
