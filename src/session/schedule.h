#pragma once
/// Progress of a run: its entire state apart from the world.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/failure.h"
#include "dynamics/step.h"
#include "io/run_store.h"
#include "scenario/scenario.h"
#include "session/measure.h"
#include "session/phase.h"

namespace talus::session {

using scenario::Scenario;

/// Record of unconverged steps and residuals.
struct SolverRecord {
  std::int64_t unconverged_deposition = 0;  ///< steps that did not reach their required tolerance
  std::int64_t unconverged_tilt = 0;
  std::int64_t unconverged_flow = 0;
  double residual_max_rest = 0.0;    ///< largest eta of a step of the tilt at rest
  double residual_max_moving = 0.0;  ///< largest eta of the other steps of the tilt

  std::int64_t unconverged() const { return unconverged_deposition + unconverged_tilt + unconverged_flow; }
};
/// Fraction of unconverged steps considered usual (docs/solver.md).
inline constexpr double usual_unconverged_share = 0.002;

/// Course of a tilt after a command has changed its rate: it grows by `rate` h per step.
struct TiltCourse {
  double rate = 0.0;       ///< rad/s
  double from = 0.0;       ///< rad, the tilt when the rate was changed
  std::int64_t since = 0;  ///< steps of the tilt taken before the change
};

/// Spring that pulls a grain to a position, m (session/command.h).
struct Drag {
  Index grain = -1;
  double x = 0.0, y = 0.0;
};

/// Range of tilts and times reached by a run; commands of the scenario whose angle or time lies within it
/// have been carried out.
struct ScriptCourse {
  double highest = 0.0, lowest = 0.0;  ///< rad, extremes of the tilt
  std::int64_t steps = 0;              ///< steps taken since the tilt began
};

/// Data of the last step for reports. No later step depends on them, so they are not part of the state. A
/// value is empty before the first step, and if the file of a resumed run or of a branch lacks it.
struct LastStep {
  std::optional<double> largest_overlap;  ///< m, at the midpoint; 0 without overlaps
  std::optional<double> residual;         ///< eta
  std::optional<double> converged;        ///< 1 if eta reached the tolerance of the step, else 0
  std::optional<double> friction;         ///< coefficient of friction used between grains
  std::optional<double> wall_friction;    ///< coefficient of friction used at side walls
};

/// Wall time, s; not part of the state.
struct RunSeconds {
  double deposition = 0.0;
  double tilt = 0.0;  ///< includes the flow
  dynamics::StageSeconds stages{};
};

/// Schedule of a run, a value type. A resumed run needs it, the world and the scenario.
struct Schedule {
  Phase phase = Phase::deposition;
  std::int64_t tilt_steps = 0;  ///< steps taken in the tilt
  std::int64_t flow_steps = 0;  ///< steps taken in the flow after failure
  /// Consecutive steps up to the last one that were not faster than deposition.rest_velocity; 0 until all
  /// grains have arrived.
  std::int64_t quiet_steps = 0;
  std::int64_t unconverged_in_a_row = 0;  ///< consecutive unconverged steps up to the last one
  Baseline baseline;
  dynamics::SurfaceFlow flow;
  double surface_height = 0.0;        ///< m, mean free surface at the last row
  double surface_displacement = 0.0;  ///< m
  double residual_since_row = 0.0;    ///< largest eta since the last row
  std::optional<double> friction;     ///< set by a command
  /// Friction between grains when the bed came to rest, if a command had set it; not part of the state.
  std::optional<double> deposition_friction;
  std::optional<TiltCourse> course;  ///< set by a command
  std::optional<Drag> drag;          ///< started by a command and not ended
  std::optional<ScriptCourse>
      script;  ///< present in a scenario with commands, from the first step of the tilt on
  /// Number of world steps at the last step of the tilt, for a programme of the tilt. Records up to it belong
  /// to the tilt, whatever its course; later ones belong to the flow.
  std::optional<std::int64_t> last_tilt_step;
  std::optional<double> angle_at_rest;  ///< rad, inclination of the free surface after failure
  SolverRecord record;
  GuardWarnings warnings;
  GuardValues broken{};  ///< values of guards that the last step exceeded and that stop the run; otherwise 0
  LastStep last;
  RunSeconds seconds;
};

/// Returns the magnitude of theta_c, rad; no value while the slope has not failed.
std::optional<double> angle_of_repose(const Schedule& schedule);

/// Whether a command of a scenario has been carried out at this point of the course.
bool is_reached(const scenario::ScriptedCommand& command, const Scenario& scenario,
                const std::optional<ScriptCourse>& course);

/// Returns the indices of the commands of a scenario that have not been carried out.
std::vector<std::size_t> waiting_commands(const Scenario& scenario, const Schedule& schedule);

/// Adds the values of a schedule to a checkpoint, under the names of a common table. Omits settings that no
/// command has changed, guards that were never exceeded, unknown values of the last step, and values of the
/// flow after failure unless the scenario `follows` it.
void store_schedule(Schedule schedule, bool follows, io::Checkpoint& checkpoint);

/// Reads the schedule from a checkpoint. Throws Error(bad_data) if a value is missing or impossible; messages
/// name the file `origin` and the `group` of the checkpoint in it.
Schedule stored_schedule(const io::Checkpoint& checkpoint, bool follows, const std::string& origin,
                         const std::string& group = "/checkpoint");

}  // namespace talus::session
