#pragma once
/// The jobs of an ensemble in the queue of Slurm.

#include <map>
#include <string>
#include <vector>

#include "app/json.h"
#include "ensemble/slurm.h"

namespace talus::app {

struct EnsembleJobs {
  std::vector<ensemble::SlurmJob> recorded;            ///< in the folder, by their numbers
  std::map<std::string, ensemble::QueuedTasks> queue;  ///< of these, by their numbers
  std::string unknown;                                 ///< why squeue told nothing; empty where it did

  bool is_queued(const ensemble::SlurmJob& job) const { return queue.contains(job.id); }
};

/// The jobs that were submitted from a folder, as squeue knows them; it is asked only where there are any.
/// Throws as recorded_jobs does, and Error(stopped) on a signal.
EnsembleJobs jobs_of_ensemble(const std::string& folder);

/// Tasks in the queue, of all jobs together.
std::size_t count_queued(const EnsembleJobs& jobs);

/// "job 12: 2 running, 6 pending (Resources)", a line for each job; empty where there is none.
std::string jobs_text(const EnsembleJobs& jobs);

/// The same as JSON; what is queued is null where squeue told nothing.
Json jobs_json(const EnsembleJobs& jobs);

}  // namespace talus::app
