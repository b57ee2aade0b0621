#include "session/run.h"

#include <chrono>

#include "core/errors.h"

namespace talus {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void commit(Session& session, RunStore& store) {
  store.commit(session.segment(), session.checkpoint(store.seconds_writing()));
  session.clear_segment();
}

void advance_or_keep(Session& session, RunStore& store) {
  try {
    session.advance();
  } catch (const Error&) {
    // The state before the failed step is whole: keep it, so that it can be looked at.
    commit(session, store);
    throw;
  }
}

}  // namespace

RunEnd run_to_end(Session& session, RunStore& store, const RunControl& control) {
  const Clock::time_point start = Clock::now();
  Clock::time_point last_commit = start;
  while (session.phase() != Phase::done) {
    advance_or_keep(session, store);
    if (control.on_step) control.on_step({session, seconds_since(start)});
    if (control.on_frame)
      for (const Frame& frame : session.segment().frames) control.on_frame(frame);
    const bool stop = control.stop != nullptr && *control.stop != 0;
    const bool due = seconds_since(last_commit) >= session.scenario().output.checkpoint_every;
    if (stop || due || !session.segment().frames.empty()) {
      commit(session, store);
      last_commit = Clock::now();
    }
    if (stop && session.phase() != Phase::done) return RunEnd::stopped;
  }
  store.pack();
  return RunEnd::complete;
}

}  // namespace talus
