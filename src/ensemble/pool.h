#pragma once
/// Processes of this program side by side: workers, and what a worker has computed.

#include <functional>
#include <string>
#include <vector>

#include "ensemble/plan.h"

namespace talus::ensemble {

/// What one process does.
struct Job {
  std::vector<std::string> arguments;  ///< of this program, from the subcommand on
  std::string log;                     ///< file to which all it prints is appended; its folder is made
};

struct FailedJob {
  std::string log;
  int exit_code = 0;      ///< 128 + signal where a signal ended it
  std::string said = {};  ///< its last line; on a full disk, that it is full
};

/// Does all jobs side by side and returns those that ended with an error. `go_on` is asked at the
/// beginning and about twice a second: where it says no, the jobs are ended without an error, as on a signal,
/// with exit code 75. SIGINT, SIGTERM and SIGHUP are passed to the processes as SIGTERM, and once all have
/// ended Error(stopped) is thrown, in which `work` is what was stopped ("the ensemble"). Processes do not
/// outlive this one: where it is killed they get SIGTERM. Throws Error(io_error) where no process can be
/// made, Error(cannot_create) where a folder or a log cannot.
std::vector<FailedJob> run_jobs(const std::vector<Job>& jobs, const std::string& work,
                                const std::function<bool()>& go_on);

/// Throws the Error of jobs that ended with an error, with the exit code of the first. `consequence`: "left
/// out of the tables".
[[noreturn]] void refuse(const std::vector<FailedJob>& failed, const std::string& consequence);

/// A path as a word of a command: one that begins with "-" would be read as an option.
std::string path_word(const std::string& path);

}  // namespace talus::ensemble
