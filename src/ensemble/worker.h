#pragma once
/// A worker of an ensemble: acquires one member after the other, and computes each in a separate process.

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ensemble/claim.h"
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

}  // namespace talus::ensemble
