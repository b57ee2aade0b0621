#pragma once
/// Where a run stands: all of its state that is not the world.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/failure.h"
#include "dynamics/step.h"
#include "io/run_store.h"
#include "scenario/scenario.h"
#include "session/guards.h"
#include "session/measure.h"
#include "session/phase.h"

namespace talus::session {

/// How well the steps were solved so far.
struct SolverRecord {
  std::int64_t unconverged_deposition = 0;  ///< steps that did not reach the tolerance asked of them
  std::int64_t unconverged_tilt = 0;
  std::int64_t unconverged_flow = 0;
  double residual_max_rest = 0.0;    ///< worst eta of a step of the tilt at rest
  double residual_max_moving = 0.0;  ///< worst eta of the other steps of the tilt
};

/// A tilt whose rate a command has changed: from then on `rate` h a step.
struct TiltCourse {
  double rate = 0.0;       ///< rad/s
  double from = 0.0;       ///< rad, the tilt when the rate was changed
  std::int64_t since = 0;  ///< steps of the tilt taken by then
};

/// A grain that is pulled by a spring to a place, m (session/drag.h).
struct Drag {
  Index grain = -1;
  double x = 0.0, y = 0.0;
};

/// How far a run has come in the commands of its scenario: those whose angle or time lies within have been
/// carried out.
struct ScriptCourse {
  double highest = 0.0, lowest = 0.0;  ///< rad, tilts that were reached
  std::int64_t steps = 0;              ///< taken since the tilt began
};

/// Wall time, s; never enters the state.
struct RunSeconds {
  double deposition = 0.0;
  double tilt = 0.0;  ///< and what follows it
  dynamics::StageSeconds stages{};
};

/// A value: with the world and the scenario it is all that a resumed run needs.
struct Schedule {
  Phase phase = Phase::deposition;
  std::int64_t tilt_steps = 0;   ///< taken in the phase
  std::int64_t flow_steps = 0;   ///< taken in the phase
  std::int64_t quiet_steps = 0;  ///< in a row, until now
  std::int64_t unconverged_in_a_row = 0;
  Baseline baseline;
  dynamics::SurfaceFlow flow;
  double surface_height = 0.0;         ///< m, mean free surface at the last row
  double surface_displacement = 0.0;   ///< m
  double residual_since_row = 0.0;     ///< worst eta since the last row
  std::optional<double> friction;      ///< set by a command
  std::optional<TiltCourse> course;    ///< set by a command
  std::optional<Drag> drag;            ///< begun by a command, and not ended
  std::optional<ScriptCourse> script;  ///< of a scenario with commands, from the first step of the tilt on
  /// With a programme of the tilt: steps of the world when the last step of the tilt was taken. What is
  /// recorded up to it is of the tilt, however far this went up and down; what comes later is of the flow.
  std::optional<std::int64_t> last_tilt_step;
  std::optional<double> angle_at_rest;  ///< rad, of the free surface after failure
  SolverRecord record;
  GuardWarnings warnings;
  GuardValues broken{};  ///< of the guards that the last step has broken, and that stop the run; else 0
  RunSeconds seconds;
};

/// theta_c, rad, a magnitude; no value while the slope has not failed.
std::optional<double> angle_of_repose(const Schedule& schedule);

/// Whether a command of a scenario is carried out by then.
bool is_reached(const scenario::ScriptedCommand& command, const scenario::Scenario& scenario,
                const std::optional<ScriptCourse>& course);

/// The indices of the commands of a scenario that have not been carried out.
std::vector<std::size_t> waiting_commands(const scenario::Scenario& scenario, const Schedule& schedule);

/// Adds the values of a schedule to a checkpoint, under the names of one table. What no command has changed,
/// what was never broken, and, unless the scenario `follows` the slope after failure, what belongs to that,
/// is left out.
void store_schedule(Schedule schedule, bool follows, io::Checkpoint& checkpoint);

/// The schedule in a checkpoint. Throws Error(bad_data) where it lacks a value or has an impossible one;
/// `origin` is what messages call the file, and `group` where the checkpoint stands in it.
Schedule stored_schedule(const io::Checkpoint& checkpoint, bool follows, const std::string& origin,
                         const std::string& group = "/checkpoint");

/// A hash of all values of the table that are state, to the last bit: not of wall times.
std::uint64_t schedule_hash(Schedule schedule);

}  // namespace talus::session
