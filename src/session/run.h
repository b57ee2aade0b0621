#pragma once
/// Carrying a run through: step, record, commit, stop on request.

#include <chrono>
#include <csignal>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "session/session.h"

namespace talus::session {

/// What a client is told while a run goes on.
struct RunProgress {
  const Session& session;
  double wall_seconds = 0.0;  ///< since run_to_end was called
};

struct RunControl {
  /// Set from outside (a signal handler) to stop after the step under way.
  const volatile std::sig_atomic_t* stop = nullptr;
  /// Set from outside to commit after the step under way and go on; run_to_end clears it.
  volatile std::sig_atomic_t* checkpoint = nullptr;
  /// Wall time that the run may take since `begun`, s: it stops in time for that, see time_is_up.
  std::optional<double> max_wall;
  std::chrono::steady_clock::time_point begun = std::chrono::steady_clock::now();
  /// Called after each step; must not change anything the run depends on. May be empty.
  std::function<void(const RunProgress&)> on_step;
  /// Called with each new frame before it is committed; must not change anything the run depends on, nor
  /// throw. May be empty.
  std::function<void(const Frame&)> on_frame;
  /// Tries something with copies of the bed after a step, and returns what became of them: it is committed at
  /// once. Must not change anything the run depends on. May be empty.
  std::function<std::vector<TrialRow>(const Session&)> trials;
  /// Packs the run when it is done, as RunStore::pack with `goes_on`; returns what that does. Empty: that.
  std::function<bool(io::RunStore& store, const std::function<bool()>& goes_on)> pack;
};

enum class RunEnd { complete, stopped };

/// Whether a run must stop now to be over within the time it is allowed: when less than a hundredth of that
/// is left, or less than twice its longest step so far, commit included. All in seconds of wall time.
bool time_is_up(double allowed, double elapsed, double longest_step);

/// Steps the session to its end and commits to the store: at each frame, every output.checkpoint_every
/// seconds of wall time, and when it stops. A complete run is packed into its file; one that is told to stop
/// meanwhile stays a folder. An error is thrown on after what was computed before it has been committed.
RunEnd run_to_end(Session& session, io::RunStore& store, const RunControl& control);

/// Steps a new session to the state after `steps` steps, and does each command where its step number says.
/// What it records goes to the store, if there is one, as in run_to_end; a run that is then done is packed,
/// another stays a folder. Ends early where the session is done before, or where `control` asks for it
/// (stopped). Throws Error(bad_data) where a command cannot be done, and as Session::advance before the last
/// step.
RunEnd replay(Session& session, io::RunStore* store, std::span<const Command> commands, std::int64_t steps,
              const RunControl& control);

}  // namespace talus::session
