#pragma once
/// Goals of the tilt: an angle that a run passes from the side on which it was when the goal was set.

#include <optional>

#include "core/command.h"
#include "session/session.h"

namespace talus::session {

struct TiltGoal {
  double tilt = 0.0;  ///< rad
  bool rises = true;  ///< the tilt was below it
};

/// Returns the goal of a run in its present state; `tilt` in rad.
TiltGoal tilt_goal(double tilt, const Session& session);

/// Whether the tilt of a deposited bed is at the goal or beyond it, up to rounding.
bool is_passed(const TiltGoal& goal, const Session& session);

/// Returns the command that turns the tilt towards the goal: its present rate with the other sign. No value
/// if the tilt does not lead away from the goal, is held, follows a programme, or belongs to a flow.
std::optional<Command> turning_command(const TiltGoal& goal, const Session& session);

/// Throws Error(usage) if the present course of the tilt never passes the goal: because the tilt is held or
/// leads away and no command of the scenario is to set its rate, because its programme does not get there, or
/// because the slope has failed. A run that ends before the goal is not an error.
void require_reachable(const TiltGoal& goal, const Session& session);

/// Whether the tilt is held, and no command of the scenario will set its rate at a later time.
bool is_held(const Session& session);

}  // namespace talus::session
