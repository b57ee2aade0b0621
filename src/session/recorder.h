#pragma once
/// What a session records, into its store: when a commit is due, and the last of them.

#include <chrono>
#include <vector>

#include "session/session.h"

namespace talus::session {

/// Commits a session to a store. Neither is owned.
class Recorder {
 public:
  Recorder(Session& session, io::RunStore& store) : session_(&session), store_(&store) {}

  /// Takes a step of the session. Where it cannot be taken, the state before it, which is whole, is
  /// committed, so that it can be looked at, and what the step throws goes through.
  void advance();
  /// Makes durable what the session has recorded since the last commit, and its state; with trials of it.
  void commit(const std::vector<TrialRow>& trials = {});
  /// The same where it is due: with a new frame, or output.checkpoint_every after the last commit.
  void commit_if_due();

 private:
  using Clock = std::chrono::steady_clock;
  Session* session_;
  io::RunStore* store_;
  Clock::time_point last_ = Clock::now();
};

}  // namespace talus::session
