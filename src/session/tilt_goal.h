#pragma once
/// Goals of the tilt: an angle that a run passes from the side on which it was when the goal was set.

#include <functional>
#include <string>

#include "core/command.h"
#include "session/session.h"

namespace talus::session {

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

}  // namespace talus::session
