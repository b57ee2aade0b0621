#pragma once
/// An ensemble as a Slurm job array: the script of its tasks, the arguments of Slurm's commands, and the
/// parsing of their output. Nothing here starts a program.

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

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

/// Returns the bash script of each task. It runs a worker, and calls `talus ensemble requeue` to be started
/// again if the time was over or the worker was killed. Paths are quoted by shell_quoted.
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

/// Parses the job in the last line printed by `sbatch --parsable`, "12" or "12;cluster"; nothing if there is
/// none.
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

}  // namespace talus::ensemble
