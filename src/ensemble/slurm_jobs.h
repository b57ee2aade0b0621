#pragma once
/// The Slurm jobs of an ensemble: files in its folder that record the submitted jobs, and the progress at the
/// time when a task last asked to be requeued.

#include <cstdint>
#include <string>
#include <vector>

#include "ensemble/plan.h"
#include "ensemble/slurm.h"

namespace talus::ensemble {

/// Returns DIR/slurm, which contains the script job.sh and a file for each job, job-12.csv.
std::string slurm_folder(const std::string& folder);

/// Record and remove a job. Each job has its own file, so that any number of processes may do this
/// concurrently. Throw the errors of write_text and remove_file.
void record_job(const std::string& folder, const SlurmJob& job);
void forget_job(const std::string& folder, const SlurmJob& job);

/// Returns the jobs that were recorded and not removed, ordered by number. Throws Error(bad_data) if a file
/// is not in the form that record_job writes.
std::vector<SlurmJob> recorded_jobs(const std::string& folder);

/// Progress of an ensemble.
struct EnsembleMark {
  std::uint64_t done = 0;   ///< completed members
  std::uint64_t steps = 0;  ///< steps committed in the runs under way
  bool operator==(const EnsembleMark&) const = default;
};
EnsembleMark mark_of(const EnsemblePlan& plan);

/// Whether `now` is further than `before`. The number of completed members is compared first, because the
/// steps of a completed member no longer count.
bool is_further(const EnsembleMark& now, const EnsembleMark& before);

/// Number of consecutive starts without progress of any member after which a task is not queued again.
inline constexpr int max_idle_starts = 3;

/// The progress that a task remembers from one start to the next.
struct TaskMemory {
  EnsembleMark mark;
  int idle_starts = 0;
};

/// Returns `before` updated by one more start, after which the ensemble is at `now`.
TaskMemory after_start(const TaskMemory& before, const EnsembleMark& now);

/// Reads the memory of task `task` of a job, DIR/slurm/task-12_3.csv; that of a first start if the file is
/// missing or unreadable.
TaskMemory read_memory(const std::string& folder, const std::string& job, const std::string& task);
void write_memory(const std::string& folder, const std::string& job, const std::string& task,
                  const TaskMemory& memory);

}  // namespace talus::ensemble
