#pragma once
/// Execution of a run: step, record, commit, stop on request; goals of the tilt.

#include <chrono>
#include <csignal>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/command.h"
#include "session/session.h"

namespace talus::session {

// Goals of the tilt: an angle that a run passes from the side on which it was when the goal was set.

struct TiltGoal {
  double tilt = 0.0;  ///< rad
  bool rises = true;  ///< the tilt was below it
};

/// Whether the tilt of a deposited bed is at the goal or beyond it, up to rounding.
bool is_passed(const TiltGoal& goal, const Session& session);

/// Returns the reason why the present course of the tilt never passes the goal: the tilt is held or leads
/// away and no command of the scenario is to set its rate, its programme does not get there, or the slope has
/// failed. Empty if it does, or if the run may end before.
std::string why_never(const TiltGoal& goal, const Session& session);

/// Returns the goal of a run in its present state; `tilt` in rad. A goal that lies behind the tilt, on its
/// course, by less than one step is passed: the last step has reached it. If the tilt leads away from it,
/// `apply` receives a command that turns it: its present rate with the other sign. A programme is left as it
/// is. Throws Error(usage) with the reason if the tilt never passes the goal (why_never).
TiltGoal aim(double tilt, const Session& session, const std::function<void(const Command&)>& apply);

/// Whether the tilt is held, and no command of the scenario will set its rate at a later time.
bool is_held(const Session& session);

// Commits of the data recorded by a session to its store.

/// Commits a session to a store. It owns neither.
class Recorder {
 public:
  Recorder(Session& session, io::RunStore& store) : session_(&session), store_(&store) {}

  /// Takes a step of the session. If the step fails, commits the intact state before it, so that it can be
  /// inspected, and rethrows.
  void advance();
  /// Commits the data recorded since the last commit and the current state, with the trials of that state.
  void commit(const std::vector<TrialRow>& trials = {});
  /// Commits if a commit is due: with a new frame, or output.checkpoint_every after the last commit.
  void commit_if_due();

 private:
  using Clock = std::chrono::steady_clock;
  Session* session_;
  io::RunStore* store_;
  Clock::time_point last_ = Clock::now();
};

/// Progress reported to a client during a run.
struct RunProgress {
  const Session& session;
  double wall_seconds = 0.0;  ///< time since the call of run_to_end
};

struct RunControl {
  /// Flag set externally (by a signal handler) to stop after the current step.
  const volatile std::sig_atomic_t* stop = nullptr;
  /// Flag set externally to commit after the current step and continue; run_to_end clears it.
  volatile std::sig_atomic_t* checkpoint = nullptr;
  /// Wall time allowed since `begun`, s; the run stops in time, see time_is_up.
  std::optional<double> max_wall;
  std::chrono::steady_clock::time_point begun = std::chrono::steady_clock::now();
  /// Called after each step; must not change anything the run depends on. May be empty.
  std::function<void(const RunProgress&)> on_step;
  /// Called with each new frame before it is committed; must not change anything the run depends on, nor
  /// throw. May be empty.
  std::function<void(const Frame&)> on_frame;
  /// Called after a step to make trials on copies of the bed; the returned rows are committed at once. Must
  /// not change anything the run depends on. May be empty.
  std::function<std::vector<TrialRow>(const Session&)> trials;
  /// Called to pack a finished run; same contract as RunStore::pack with `should_continue`. Empty:
  /// RunStore::pack itself.
  std::function<bool(io::RunStore& store, const std::function<bool()>& should_continue)> pack;
};

enum class RunEnd { complete, stopped };

/// Whether a run must stop to finish within its allowed time: when less than a hundredth of it is left, or
/// less than twice its longest step so far, including the commit. All in seconds of wall time.
bool time_is_up(double allowed, double elapsed, double longest_step);

/// Steps the session to its end and commits to the store: at each frame, every output.checkpoint_every
/// seconds of wall time, and when it stops. A complete run is packed into its file; a run stopped before its
/// end stays a folder. Errors are rethrown after the data computed before them have been committed.
RunEnd run_to_end(Session& session, io::RunStore& store, const RunControl& control);

/// Steps a new session to the state after `steps` steps, and applies each command at its step. Recorded data
/// go to the store, if given, as in run_to_end; a run that is then done is packed, others stay folders. Ends
/// early if the session is done, or if `control` requests a stop (stopped). Throws Error(bad_data) if a
/// command cannot be applied, and as Session::advance does before the last step.
RunEnd replay(Session& session, io::RunStore* store, std::span<const Command> commands, std::int64_t steps,
              const RunControl& control);

}  // namespace talus::session
