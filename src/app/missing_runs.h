#pragma once
/// Runs that a command needs: what is complete is kept, the rest is computed side by side.

#include <string>
#include <vector>

#include "app/child_runs.h"
#include "app/runs_progress.h"
#include "session/scenario.h"

namespace talus {

struct WantedRun {
  std::string name;                   ///< in the progress: "baseline/seed-1"
  std::string path;                   ///< its file
  std::string scenario_file;          ///< that of `talus run`
  std::vector<std::string> settings;  ///< "key=value", without the seed
  Scenario scenario;                  ///< what they give, with the seed
};

struct FailedRun {
  std::string log;
  int exit_code = 0;
};

/// Computes those that are not complete, in their order, `jobs` at a time, each as `talus run --resume` on
/// one thread with a log beside its file, and returns the runs that ended with an error. `whole` is what they
/// are parts of ("study"). Throws Error(bad_data) where the run at a path has another scenario,
/// Error(stopped) where a signal asked to stop.
std::vector<FailedRun> compute_missing(const std::vector<WantedRun>& runs, int jobs,
                                       const std::string& whole);

/// Runs children side by side, with the progress of `complete` that were there before and of those awaited,
/// one for each child; what ended with an error is returned. Throws Error(stopped) as compute_missing does.
std::vector<FailedRun> run_with_progress(const std::vector<ChildRun>& children, ProgressWords words,
                                         std::vector<AwaitedRun> awaited, std::size_t complete, int jobs,
                                         const std::string& whole);

/// Throws the Error of runs that ended with an error, with the exit code of the first. `consequence`: "left
/// out of the tables".
[[noreturn]] void refuse(const std::vector<FailedRun>& failed,
                         const std::string& consequence = "left out of the tables");

/// Makes a folder, and those above it. Throws Error(cannot_create).
void make_folders(const std::string& folder);

}  // namespace talus
