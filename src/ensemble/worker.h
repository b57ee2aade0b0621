#pragma once
/// A worker of an ensemble: takes one member after the other, and has each computed by a process of its own.

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
  std::optional<double> max_wall;  ///< s that it may take
  /// Called at each member that it takes and that ends: `exit_code` is -1 where it begins. May be empty.
  std::function<void(const std::string& member, int exit_code)> tell;
  std::string only = {};  ///< the one member that it may take; empty: any
  /// Called when a member is left for later, since another process writes its run. May be empty.
  std::function<void(const std::string& member, const std::string& writer)> tell_wait = {};
};

/// How a worker ended.
struct WorkerEnd {
  std::size_t done = 0;       ///< by this worker
  std::size_t failed = 0;     ///< by this worker
  std::size_t elsewhere = 0;  ///< members that others are computing
  bool enough = false;        ///< the precision that was asked for is reached
};

/// Whether there is a member that a worker could begin now: it waits, or its claim is dead.
bool has_work(const EnsemblePlan& plan, const std::vector<MemberState>& states, ClaimWatch& watch);

/// Works until there is nothing left to begin: every member is done, has failed, or is being computed by
/// somebody whose claim is alive. The manifest is read again before each member, so members may be added
/// meanwhile. The longest members come first. One whose run another process writes is left for later, and
/// waited for when there is nothing else to begin. A member that fails is recorded, and the next one begun.
/// Throws Error(stopped) on SIGINT, SIGTERM and SIGHUP and where its time is over, after the member under way
/// has committed a checkpoint; and as read_ensemble does.
WorkerEnd work_on_ensemble(const WorkerOptions& options);

}  // namespace talus::ensemble
