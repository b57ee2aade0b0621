#pragma once
/// `talus ensemble submit` and related commands: workers as a Slurm job array, and its jobs in the queue.

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "app/json.h"
#include "ensemble/slurm.h"

namespace talus::app {

/// Adds submit, cancel and requeue to `talus ensemble`; requeue is called by the script of a task.
void add_submit_commands(CLI::App& ensemble);

struct EnsembleJobs {
  std::vector<ensemble::SlurmJob> recorded;            ///< jobs recorded in the folder, by number
  std::map<std::string, ensemble::QueuedTasks> queue;  ///< tasks of the recorded jobs, by job number
  std::string unknown;                                 ///< error of squeue; empty if it succeeded
};

/// Returns the jobs submitted from a folder and their state in squeue, which is called only if jobs are
/// recorded. Throws as recorded_jobs does, and Error(stopped) on a signal.
EnsembleJobs jobs_of_ensemble(const std::string& folder);

/// Returns a line for each job, such as "job 12: 2 running, 6 pending (Resources)"; empty without jobs.
std::string jobs_text(const EnsembleJobs& jobs);

/// Returns the same as JSON; the queued tasks are null if squeue failed.
Json jobs_json(const EnsembleJobs& jobs);

}  // namespace talus::app
