#include "session/tilt_goal.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/core.h>
#include <string>

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
  const scenario::Scenario& scenario = session.scenario();
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

/// Returns the rate, deg/s, that a command set; the conversion of angles may have changed its last digits.
double as_given(double rate) {
  const std::string text = fmt::format("{:.15g}", degrees(rate));
  double given = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), given);
  return given;
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
    return never_text(goal,
                      fmt::format("its programme (tilt.program) does not get there from {} deg; setting "
                                  "tilt_rate ends the programme",
                                  degrees_text(session.world().tilt, 3)));
  }
  if (is_held(session)) return never_text(goal, "it is held; set its rate first (tilt_rate)");
  if (!leads_away(goal, rate) || rate_will_change(session, false)) return {};
  return never_text(goal, fmt::format("it changes by {:.4g} deg/s (tilt_rate), away from it", degrees(rate)));
}

TiltGoal aim(double tilt, const Session& session, const std::function<void(const Command&)>& apply) {
  const bool rises = is_just_passed(tilt, session) ? session.tilt_rate() > 0.0 : session.world().tilt <= tilt;
  const TiltGoal goal{tilt, rises};
  if (needs_turn(goal, session)) apply({0, CommandKind::tilt_rate, -1, -as_given(session.tilt_rate())});
  if (const std::string reason = why_never(goal, session); !reason.empty())
    throw Error(ExitCode::usage, reason);
  return goal;
}

}  // namespace talus::session
