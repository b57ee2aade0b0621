#include "session/run.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/text.h"
#include "core/trigonometry.h"

namespace talus::session {

namespace {

constexpr double reached_within = 1e-9;  // rad, because a tilt is a sum of steps with rounding errors

bool is_beyond(const TiltGoal& goal, double tilt) {
  return goal.rises ? tilt >= goal.tilt - reached_within : tilt <= goal.tilt + reached_within;
}

/// Whether the tilt moves away from the goal.
bool leads_away(const TiltGoal& goal, double rate) { return goal.rises ? rate < 0.0 : rate > 0.0; }

/// Whether a command of the scenario that sets the rate of the tilt is still to come. While the tilt is held,
/// no angle is reached.
bool rate_will_change(const Session& session, bool held) {
  const Scenario& scenario = session.scenario();
  return std::ranges::any_of(waiting_commands(scenario, session.schedule()), [&](std::size_t k) {
    const scenario::ScriptedCommand& command = scenario.commands[k];
    return command.kind == CommandKind::tilt_rate && (!held || (command.time && command.x != 0.0));
  });
}

bool program_passes(const TiltGoal& goal, const Session& session) {
  return std::ranges::any_of(session.program().segments(), [&](const scenario::TiltSegment& segment) {
    return segment.end() > session.schedule().tilt_steps && is_beyond(goal, radians(segment.to));
  });
}

std::string never_text(const TiltGoal& goal, const std::string& reason) {
  return fmt::format("the tilt never reaches {} deg: {}", degrees_text(goal.tilt, 3), reason);
}

/// Whether the tilt can be turned and leads away from the goal.
bool needs_turn(const TiltGoal& goal, const Session& session) {
  const bool tilts = session.phase() == Phase::deposition || session.phase() == Phase::tilt;
  return tilts && !session.follows_program() && !is_passed(goal, session) &&
         leads_away(goal, session.tilt_rate());
}

/// Whether the tilt, on its present course, is beyond an angle by less than one step.
bool is_just_passed(double angle, const Session& session) {
  const double step = session.tilt_rate() * scenario::time_step(session.scenario());
  const double beyond = step > 0.0 ? session.world().tilt - angle : angle - session.world().tilt;
  return beyond >= 0.0 && beyond < std::fabs(step) - reached_within;
}

}  // namespace

bool is_passed(const TiltGoal& goal, const Session& session) {
  return session.phase() != Phase::deposition && is_beyond(goal, session.world().tilt);
}

bool is_held(const Session& session) {
  return session.phase() == Phase::tilt && !session.follows_program() && session.tilt_rate() == 0.0 &&
         !rate_will_change(session, true);
}

std::string why_never(const TiltGoal& goal, const Session& session) {
  const Phase phase = session.phase();
  if (phase == Phase::deposition || phase == Phase::done || is_passed(goal, session)) return {};
  if (phase == Phase::flow) {
    const bool lowered = session.scenario().tilt.after_failure == scenario::AfterFailure::lower;
    if (lowered && is_beyond(goal, 0.0)) return {};
    return never_text(goal, fmt::format("the slope has failed, and its tilt is {} (tilt.after_failure)",
                                        lowered ? "lowered" : "held"));
  }
  const double rate = session.tilt_rate();
  if (session.follows_program()) {
    if (program_passes(goal, session) || rate_will_change(session, false)) return {};
    return never_text(goal, fmt::format("its programme (tilt.program) does not get there from {} deg; "
                                        "setting tilt_rate ends the programme",
                                        degrees_text(session.world().tilt, 3)));
  }
  if (is_held(session)) return never_text(goal, "it is held; set its rate first (tilt_rate)");
  if (!leads_away(goal, rate) || rate_will_change(session, false)) return {};
  return never_text(goal, fmt::format("it changes by {:.4g} deg/s (tilt_rate), away from it", degrees(rate)));
}

TiltGoal aim(double tilt, const Session& session, const std::function<void(const Command&)>& apply) {
  const bool rises = is_just_passed(tilt, session) ? session.tilt_rate() > 0.0 : session.world().tilt <= tilt;
  const TiltGoal goal{tilt, rises};
  // The rate in deg/s as a command set it; the conversion of angles may have changed its last digits.
  const auto rate = parse_number<double>(fmt::format("{:.15g}", degrees(session.tilt_rate())));
  if (needs_turn(goal, session)) apply({0, CommandKind::tilt_rate, -1, -rate.value_or(0.0)});
  if (const std::string reason = why_never(goal, session); !reason.empty())
    throw Error(ExitCode::usage, reason);
  return goal;
}

void Recorder::advance() {
  try {
    session_->advance();
  } catch (const Error&) {
    commit();
    throw;
  }
}

void Recorder::commit(const std::vector<TrialRow>& trials) {
  io::Segment segment = session_->segment();
  segment.trials = trials;
  store_->commit(segment, session_->checkpoint(store_->seconds_writing()));
  session_->clear_segment();
  last_ = Clock::now();
}

void Recorder::commit_if_due() {
  const std::chrono::duration<double> since = Clock::now() - last_;
  if (since.count() >= session_->scenario().output.checkpoint_every || !session_->segment().frames.empty())
    commit();
}

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
    throw Error(ExitCode::bad_data, "data sets /commands at step {}: {}", command.step, error.what());
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
