#pragma once
/// An ensemble as a Slurm job array: the script of its tasks, the arguments of Slurm's commands and the
/// parsing of their output, and the files that record jobs and their progress. Nothing here starts a program.

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ensemble/plan.h"

namespace talus::ensemble {

/// The work of one job array.
struct SlurmArray {
  std::string program;  ///< absolute path of talus
  std::string folder;   ///< absolute path of the ensemble
  std::size_t tasks = 1;
  std::optional<double> time;  ///< time limit of a task, s; nothing: the limit of the partition
  double stale = 120.0;        ///< s, see ClaimTimes
};

/// Default and largest number of tasks in an array; Slurm accepts the largest with its default settings.
inline constexpr std::size_t usual_tasks = 100, max_tasks = 1000;

/// Returns the time before the end of a task at which Slurm sends SIGUSR1 to its script, s: one minute, or a
/// tenth of the time limit if it is below ten minutes. The worker stops by itself at twice that time before
/// the end.
double time_reserve(const std::optional<double>& time);

/// Formats a time of at least one second as "03:58:00", which Slurm and talus both read.
std::string time_text(double seconds);

/// Returns the shell command of a worker on one line: 'talus ensemble work FOLDER ...'. Throws Error(usage)
/// if a path contains a line break.
std::string worker_command(const SlurmArray& array);

/// Returns the bash script of each task. It runs a worker for each processor of the task, and calls `talus
/// ensemble requeue` to be started again if the time was over or a worker was killed. Paths are quoted by
/// shell_quoted.
std::string job_script(const SlurmArray& array);

/// Returns the `sbatch` command for that script, which is `slurm/job.sh` in the working directory of sbatch.
/// No argument contains a path. `options` come last and so take precedence.
std::vector<std::string> sbatch_arguments(const SlurmArray& array, const std::vector<std::string>& options);

/// A job that was submitted.
struct SlurmJob {
  std::string id;       ///< digits
  std::string cluster;  ///< set if sbatch named one
  std::size_t tasks = 0;
};

/// Whether a text is the number of a job or of a task.
bool is_slurm_number(const std::string& text);

/// Parses the job in the last line printed by `sbatch --parsable`, "12" or "12;cluster", if any.
std::optional<SlurmJob> parse_submitted(const std::string& printed);

/// Tasks of one job in the queue, by state, such as "RUNNING".
struct QueuedTasks {
  std::map<std::string, std::size_t> count;
  std::vector<std::string> reasons;  ///< distinct reasons of the pending tasks
};
std::size_t total(const QueuedTasks& tasks);

/// Return the `squeue` or `scancel` command for the jobs of one cluster.
std::vector<std::string> squeue_words(const std::vector<SlurmJob>& jobs);
std::vector<std::string> scancel_words(const std::vector<SlurmJob>& jobs);

/// Returns the `scontrol requeue` command for one task. The last task of an array has the number of the array
/// as its SLURM_JOB_ID; requeueing by that id would restart all tasks, including completed ones.
std::vector<std::string> requeue_words(const std::string& job, const std::string& task);

/// Parses the output of squeue_words, by job number. Finished tasks and lines in another form are ignored.
std::map<std::string, QueuedTasks> parse_queue(const std::string& printed);

/// Groups jobs by cluster, because Slurm's commands address one cluster at a time.
std::map<std::string, std::vector<SlurmJob>> by_cluster(const std::vector<SlurmJob>& jobs);

/// Returns DIR/slurm, which contains the script job.sh and a file for each job, job-12.csv.
std::string slurm_folder(const std::string& folder);

/// Record and remove a job. Each job has its own file, so that any number of processes may do this
/// concurrently. Throw the errors of write_text and remove_file.
void record_job(const std::string& folder, const SlurmJob& job);
void forget_job(const std::string& folder, const SlurmJob& job);

/// Returns the jobs that were recorded and not removed, ordered by number. Throws Error(bad_data) if a file
/// is not in the form that record_job writes.
std::vector<SlurmJob> recorded_jobs(const std::string& folder);

/// Progress of an ensemble. Completed members are compared first, because their steps no longer count.
struct EnsembleMark {
  std::uint64_t done = 0;   ///< completed members
  std::uint64_t steps = 0;  ///< steps committed in the runs under way
  // NOLINTNEXTLINE(modernize-use-nullptr): a finding of clang-tidy 14 in the generated code
  auto operator<=>(const EnsembleMark&) const = default;
};
EnsembleMark mark_of(const EnsemblePlan& plan);

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
