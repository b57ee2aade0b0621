#include "session/run.h"

#include <algorithm>
#include <chrono>
#include <fmt/core.h>

#include "base/errors.h"
#include "session/recorder.h"

namespace talus::session {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void report_progress(const Session& session, Clock::time_point start, const RunControl& control) {
  if (control.on_step) control.on_step({session, seconds_since(start)});
  if (control.on_frame)
    for (const Frame& frame : session.segment().frames) control.on_frame(frame);
}

bool stops(const RunControl& control) { return control.stop != nullptr && *control.stop != 0; }

bool takes_checkpoint(const RunControl& control) {
  if (control.checkpoint == nullptr || *control.checkpoint == 0) return false;
  *control.checkpoint = 0;
  return true;
}

/// Applies a recorded command; one that the session rejects cannot belong to the run.
void apply(Session& session, const Command& command) {
  try {
    session.apply(command);
  } catch (const Error& error) {
    throw Error(ExitCode::bad_data,
                fmt::format("data sets /commands at step {}: {}", command.step, error.what()));
  }
}

/// Takes a step of a replay. The original run may have ended with an error after its last step, and then so
/// does this one.
void advance_to(Session& session, std::int64_t steps) {
  try {
    session.advance();
  } catch (const Error&) {
    if (session.world().step < steps) throw;
  }
}

}  // namespace

bool time_is_up(double allowed, double elapsed, double longest_step) {
  return allowed - elapsed <= std::max(0.01 * allowed, 2.0 * longest_step);
}

RunEnd run_to_end(Session& session, io::RunStore& store, const RunControl& control) {
  const Clock::time_point start = Clock::now();
  double longest_step = 0.0;
  const auto must_stop = [&] {
    return stops(control) ||
           (control.max_wall && time_is_up(*control.max_wall, seconds_since(control.begun), longest_step));
  };
  Recorder recorder(session, store);
  while (session.phase() != Phase::done) {
    const Clock::time_point step_start = Clock::now();
    recorder.advance();
    report_progress(session, start, control);
    const std::vector<TrialRow> trials = control.trials ? control.trials(session) : std::vector<TrialRow>();
    const bool stop = must_stop();
    if (takes_checkpoint(control) || stop || !trials.empty())
      recorder.commit(trials);
    else
      recorder.commit_if_due();
    if (stop && session.phase() != Phase::done) return RunEnd::stopped;
    longest_step = std::max(longest_step, seconds_since(step_start));
  }
  const auto should_continue = [&] { return !must_stop(); };
  return (control.pack ? control.pack(store, should_continue) : store.pack(should_continue))
             ? RunEnd::complete
             : RunEnd::stopped;
}

RunEnd replay(Session& session, io::RunStore* store, std::span<const Command> commands, std::int64_t steps,
              const RunControl& control) {
  const Clock::time_point start = Clock::now();
  std::optional<Recorder> recorder;
  if (store != nullptr) recorder.emplace(session, *store);
  session.follow_script(false);  // its commands are among the recorded ones
  auto next = commands.begin();
  while (true) {
    for (; next != commands.end() && next->step == session.world().step; ++next) apply(session, *next);
    const bool stop = stops(control);
    if (stop || session.world().step >= steps || session.phase() == Phase::done) break;
    advance_to(session, steps);
    report_progress(session, start, control);
    if (recorder)
      recorder->commit_if_due();
    else
      session.clear_segment();
  }
  if (recorder) recorder->commit();
  if (session.world().step < steps && session.phase() != Phase::done) return RunEnd::stopped;
  if (store != nullptr && session.phase() == Phase::done) store->pack();
  return RunEnd::complete;
}

}  // namespace talus::session
