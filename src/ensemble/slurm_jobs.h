#pragma once
/// The jobs of an ensemble: files in its folder that tell which were submitted, and how far it was when a
/// task last asked to be queued again.

#include <cstdint>
#include <string>
#include <vector>

#include "ensemble/plan.h"
#include "ensemble/slurm.h"

namespace talus::ensemble {

/// DIR/slurm, with the script job.sh and a file for each job, job-12.csv.
std::string slurm_folder(const std::string& folder);

/// Remembers a job, and forgets it. A job has a file of its own, so that any number of processes may do it at
/// a time. Throw as write_text and remove_file do.
void record_job(const std::string& folder, const SlurmJob& job);
void forget_job(const std::string& folder, const SlurmJob& job);

/// The jobs that were recorded and not forgotten, by their numbers. Throws Error(bad_data) where the file of
/// one is not what record_job writes.
std::vector<SlurmJob> recorded_jobs(const std::string& folder);

/// How far an ensemble is.
struct EnsembleMark {
  std::uint64_t done = 0;   ///< members
  std::uint64_t steps = 0;  ///< committed in the runs that are under way
  bool operator==(const EnsembleMark&) const = default;
};
EnsembleMark mark_of(const EnsemblePlan& plan);

/// Whether any member has come further from `before` to `now`. A member that is done counts no steps any
/// more: the first of these numbers that differs tells.
bool is_further(const EnsembleMark& now, const EnsembleMark& before);

/// Starts of a task, one after the other, after which no member had come further.
inline constexpr int most_idle_starts = 3;

/// What a task remembers from one start to the next.
struct TaskMemory {
  EnsembleMark mark;
  int idle_starts = 0;
};

/// `before` with one start more, after which the ensemble is at `now`.
TaskMemory after_start(const TaskMemory& before, const EnsembleMark& now);

/// The memory of task `task` of a job, DIR/slurm/task-12_3.csv; that of a first start where there is none or
/// it cannot be read.
TaskMemory read_memory(const std::string& folder, const std::string& job, const std::string& task);
void write_memory(const std::string& folder, const std::string& job, const std::string& task,
                  const TaskMemory& memory);

}  // namespace talus::ensemble
