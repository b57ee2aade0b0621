#pragma once
/// An ensemble as a job array of Slurm: the script of its tasks, the words of Slurm's commands, and what
/// these commands print. Nothing here starts a program.

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace talus::ensemble {

/// What one array is to do.
struct SlurmArray {
  std::string program;  ///< absolute path of talus
  std::string folder;   ///< absolute path of the ensemble
  std::size_t tasks = 1;
  std::optional<double> time;  ///< s that a task may take; nothing: what the partition allows
  double stale = 120.0;        ///< s, of ClaimTimes
};

/// More tasks are not submitted unless they are asked for; and so many at most, which Slurm takes as it
/// comes.
inline constexpr std::size_t usual_tasks = 100, most_tasks = 1000;

/// s before the end of a task at which Slurm sends SIGUSR1 to its script; twice as much before it the worker
/// stops by itself. A minute, or a tenth of a time below ten minutes.
double time_reserve(const std::optional<double>& time);

/// "03:58:00": what Slurm and talus read alike. At least a second.
std::string time_text(double seconds);

/// A worker in the words of a shell: 'talus ensemble work FOLDER ...', in one line. Throws Error(usage) where
/// a path has more lines than one.
std::string worker_command(const SlurmArray& array);

/// The script of each task, for bash: runs a worker, and asks by `talus ensemble requeue` for another start
/// where the time was over or the worker was killed. Paths stand in it as shell_quoted writes them.
std::string job_script(const SlurmArray& array);

/// `sbatch` for that script, called `slurm/job.sh` in the folder in which sbatch runs. No word holds a path.
/// `options` come last, so that they win.
std::vector<std::string> sbatch_words(const SlurmArray& array, const std::vector<std::string>& options);

/// A job that was submitted.
struct SlurmJob {
  std::string id;       ///< digits
  std::string cluster;  ///< where sbatch named one
  std::size_t tasks = 0;
};

/// Whether a text is the number of a job or of a task.
bool is_slurm_number(const std::string& text);

/// The job in the last line of what `sbatch --parsable` printed, "12" or "12;cluster"; nothing where there is
/// none.
std::optional<SlurmJob> parse_submitted(const std::string& printed);

/// Tasks of one job that are in the queue, by their states, such as "RUNNING".
struct QueuedTasks {
  std::map<std::string, std::size_t> count;
  std::vector<std::string> reasons;  ///< why those that are pending do, each once
};
std::size_t total(const QueuedTasks& tasks);

/// `squeue` or `scancel` for the jobs of one cluster.
std::vector<std::string> squeue_words(const std::vector<SlurmJob>& jobs);
std::vector<std::string> scancel_words(const std::vector<SlurmJob>& jobs);

/// `scontrol requeue` for one task. The last task of an array has the number of the array as its own
/// SLURM_JOB_ID, by which all tasks would be queued again, those that are done too.
std::vector<std::string> requeue_words(const std::string& job, const std::string& task);

/// What squeue_words printed, by the number of the job. Tasks that have come to their end, and lines of
/// another form, count for nothing.
std::map<std::string, QueuedTasks> parse_queue(const std::string& printed);

/// Jobs of one cluster beside each other: Slurm's commands ask one cluster at a time.
std::map<std::string, std::vector<SlurmJob>> by_cluster(const std::vector<SlurmJob>& jobs);

}  // namespace talus::ensemble
