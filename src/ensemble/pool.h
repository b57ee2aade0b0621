#pragma once
/// Parallel processes of this program: workers, and the members that workers compute.

#include <functional>
#include <string>
#include <vector>

#include "ensemble/plan.h"

namespace talus::ensemble {

/// The work of one process.
struct Job {
  std::vector<std::string> arguments;  ///< arguments of this program, from the subcommand on
  std::string log;                     ///< file to which its output is appended; its folder is created
};

struct FailedJob {
  std::string log;
  int exit_code = 0;         ///< 128 + signal if a signal ended it
  std::string message = {};  ///< its last line, or a message if the disk is full
};

/// Runs all jobs in parallel and returns those that ended with an error. `should_continue` is called at the
/// beginning and about twice a second: if it returns false, the jobs are ended without an error, as on a
/// signal, with exit code 75. SIGINT, SIGTERM and SIGHUP are passed on to the processes (pass_on_stop); once
/// all have ended, Error(stopped) is thrown, in which `work` names the interrupted work ("the ensemble").
/// Processes do not outlive this one: if it is killed, they receive SIGTERM. Throws Error(io_error) if no
/// process can be created, and Error(cannot_create) if a folder or a log cannot.
std::vector<FailedJob> run_jobs(const std::vector<Job>& jobs, const std::string& work,
                                const std::function<bool()>& should_continue);

/// Throws an Error that lists the failed jobs, with the exit code of the first: stopped if it was killed
/// from outside, internal if it crashed. `consequence` is, for example, "left out of the tables".
[[noreturn]] void refuse(const std::vector<FailedJob>& failed, const std::string& consequence);

/// Returns a path as a command-line argument; a leading "-" would be read as an option.
std::string path_word(const std::string& path);

}  // namespace talus::ensemble
