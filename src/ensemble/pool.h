#pragma once
/// A pool of processes of this program, which computes what a plan lacks, several at a time.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "ensemble/plan.h"

namespace talus {

/// What one process does.
struct Job {
  std::string name;                    ///< in the progress: "baseline/seed-1"
  std::vector<std::string> arguments;  ///< of this program, from the subcommand on
  std::string log;                     ///< file to which all it prints is appended; its folder is made
  double estimate = 0.0;               ///< s on one core, before anything is known
};

/// How far a pool is.
struct PoolProgress {
  std::size_t done = 0;  ///< what was complete before counts
  std::size_t all = 0;
  std::size_t running = 0;
  double seconds = 0.0;         ///< since it began
  double seconds_left = 0.0;    ///< by the estimates, and by how far they were off so far
  const Job* ended = nullptr;   ///< the job that has just ended; none where only time has passed
  int exit_code = 0;            ///< of this job
  double seconds_of_job = 0.0;  ///< that it took
};

struct PoolOptions {
  std::string work;     ///< "study", in the message where it is stopped
  int at_once = 1;      ///< jobs side by side
  std::size_t all = 0;  ///< of which those that are no jobs are complete
  /// Called at each end of a job, and about twice a second.
  std::function<void(const PoolProgress&)> show;
  /// Asked as often: whether the jobs under way are to be ended and no more begun, without an error. They end
  /// as on a signal, with exit code 75.
  std::function<bool()> give_up = {};
};

struct FailedJob {
  std::string log;
  int exit_code = 0;  ///< 128 + signal where a signal ended it
};

/// Does all jobs in their order and returns those that ended with an error. SIGINT, SIGTERM and SIGHUP are
/// passed to the processes as SIGTERM, no more are started, and once all have ended Error(stopped) is thrown.
/// Processes do not outlive this one: where it is killed they get SIGTERM. Throws Error(io_error) where no
/// process can be made, Error(cannot_create) where a folder or a log cannot.
std::vector<FailedJob> run_jobs(const std::vector<Job>& jobs, const PoolOptions& options);

/// Throws the Error of jobs that ended with an error, with the exit code of the first. `consequence`: "left
/// out of the tables".
[[noreturn]] void refuse(const std::vector<FailedJob>& failed,
                         const std::string& consequence = "left out of the tables");

/// Whether the run of a member is complete. `work` is what it is part of. Throws Error(bad_data) where the
/// run at its path has another scenario.
bool is_complete(const Member& member, const std::string& work);

/// The job of a member, with the log beside its run file.
Job job_of(const Member& member, std::vector<std::string> arguments);

/// Adds "--set key=value" to a command.
void add_settings(std::vector<std::string>& arguments, const std::vector<std::string>& settings);

/// A path as a word of a command: one that begins with "-" would be read as an option.
std::string path_word(const std::string& path);

}  // namespace talus
