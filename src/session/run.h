#pragma once
/// Carrying a run through: step, record, commit, stop on request.

#include <csignal>
#include <functional>
#include <span>

#include "session/session.h"

namespace talus {

/// What a client is told while a run goes on.
struct RunProgress {
  const Session& session;
  double wall_seconds = 0.0;  ///< since run_to_end was called
};

struct RunControl {
  /// Set from outside (a signal handler) to stop after the step under way.
  const volatile std::sig_atomic_t* stop = nullptr;
  /// Called after each step; must not change anything the run depends on. May be empty.
  std::function<void(const RunProgress&)> on_step;
  /// Called with each new frame before it is committed; must not change anything the run depends on, nor
  /// throw. May be empty.
  std::function<void(const Frame&)> on_frame;
};

enum class RunEnd { complete, stopped };

/// Steps the session to its end and commits to the store: at each frame, every output.checkpoint_every
/// seconds of wall time, and when it stops. A complete run is packed into its file. An error is thrown on
/// after what was computed before it has been committed.
RunEnd run_to_end(Session& session, RunStore& store, const RunControl& control);

/// Steps a new session to the state after `steps` steps, and does each command where its step number says.
/// What it records goes to the store, if there is one, as in run_to_end; a run that is then done is packed,
/// another stays a folder. Ends early where the session is done before, or where `control` asks for it
/// (stopped). Throws Error(usage) where a command cannot be done, and as Session::advance before the last
/// step.
RunEnd replay(Session& session, RunStore* store, std::span<const Command> commands, std::int64_t steps,
              const RunControl& control);

}  // namespace talus
