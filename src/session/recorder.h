#pragma once
/// Commits of the data recorded by a session to its store.

#include <chrono>
#include <vector>

#include "session/session.h"

namespace talus::session {

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

}  // namespace talus::session
