#pragma once
/// Workers of an ensemble: each computes one member after another in a process of its own, and removes the
/// frames that the ensemble does not keep.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ensemble/ensemble_manifest.h"
#include "ensemble/member_results.h"
#include "ensemble/member_state.h"
#include "ensemble/plan.h"

namespace talus::ensemble {

struct WorkerOptions {
  std::string folder;
  ClaimTimes times;
  std::optional<double> max_wall;  ///< time limit, s
  /// Called when a member begins, with `exit_code` -1, and when it ends. May be empty.
  std::function<void(const std::string& member, int exit_code)> on_change;
  std::string only = {};  ///< the only member that it may compute; empty: any
  /// Called when a member is postponed because another process writes its run. May be empty.
  std::function<void(const std::string& member, const std::string& writer)> on_wait = {};
};

/// The outcome of a worker.
struct WorkerEnd {
  std::size_t done = 0;       ///< members completed by this worker
  std::size_t failed = 0;     ///< members that failed in this worker
  std::size_t elsewhere = 0;  ///< members that others are computing
  bool enough = false;        ///< the required precision is reached
};

/// Whether a worker could begin a member: one that waits, or whose claim is dead.
bool has_work(const EnsemblePlan& plan, const std::vector<MemberState>& states, ClaimWatch& watch);

/// Computes members until none is left to begin: every member is done, has failed, or is being computed by a
/// process whose claim is alive. The manifest is read again before each member, so that members may be added
/// meanwhile. The longest members come first. A member whose run another process writes is postponed, and
/// awaited when no other is left. A failed member is recorded, and the next one begins. Throws Error(stopped)
/// on SIGINT, SIGTERM and SIGHUP and at the time limit, after the member under way has committed a
/// checkpoint; and the errors of read_ensemble.
WorkerEnd work_on_ensemble(const WorkerOptions& options);

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

/// Throws Error(usage), naming --keep, unless the text is "all", "analysis" or a number.
void check_keep(const std::string& keep);

/// Whether the frames of a seed are kept: always with "all" or an empty text, never with "analysis", and with
/// a number N for the N lowest seeds of the ensemble.
bool keeps_frames(const EnsembleManifest& manifest, std::uint64_t seed);

/// Whether a member is in the folder of its ensemble. Nothing is removed from members behind a link to
/// another place.
bool is_in_folder(const Member& member, const std::string& folder);

/// Removes the frames of all completed members that need not keep them, because `keep` was reduced after they
/// were completed. A run behind a link keeps its frames. Returns the number of changed runs.
std::size_t drop_frames(const EnsembleManifest& manifest, const EnsemblePlan& plan, const std::string& folder,
                        KnownMembers& known);

/// Removes leftovers of workers that were killed just before they would have removed them: claims of members
/// that are done or have failed, except those held by a process of this machine, and folders of packed runs.
/// A worker of another machine can at most be about to remove its own. Throws the errors of discard_folder.
void drop_leftovers(const EnsemblePlan& plan);

}  // namespace talus::ensemble
