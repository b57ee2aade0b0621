#pragma once
/// Session makes a run of a scenario. A Session steps one World through its phases (schedule.h) and takes
/// commands; run.h records and commits it; frame_state.h and deposition.h give it other beginnings;
/// run_check.h verifies the result.
///
/// A run as a value that is stepped: deposition, rest, tilt, failure, and the flow after it. The command line
/// and the interactive frontend are both thin clients of it.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/step.h"
#include "io/run_store.h"
#include "scenario/scenario.h"
#include "scenario/tilt_program.h"
#include "session/command.h"
#include "session/deposition.h"
#include "session/schedule.h"

namespace talus::session {

using scenario::Scenario;

/// Session of a run. The tolerance required of a step grows with the velocity of the bed, from
/// solver.tolerance at rest to solver.moving_tolerance at an rms velocity of g h. An error of the solver acts
/// as a velocity; it must stay well below the actual one, so that a bed can always come to rest.
class Session {
 public:
  /// Starts a new run, with the bed of the scenario before its first step. Throws Error(bad_data) if a
  /// command of the scenario cannot be applied to it.
  explicit Session(const Scenario& scenario);
  /// Restores a run from its last commit. Throws Error(bad_data) if the checkpoint lacks a value; messages
  /// name the file `origin` and the `group` of the checkpoint in it.
  Session(const Scenario& scenario, io::Checkpoint checkpoint, const std::string& origin = "the checkpoint",
          const std::string& group = "/checkpoint");

  /// Records a row and a frame of the current state, with which a branch of another run starts.
  void record_start();

  /// Makes the friction that a command has set that of the scenario, so that the header of a branch from here
  /// states it. Returns whether a command has set any.
  bool adopt_friction();

  /// Takes one step; recorded data go to segment(). Does nothing once done. Commands of the scenario whose
  /// angle or time has come are carried out before a step of the tilt or of the flow, as by apply. Throws
  /// Error(bad_data) if the bed does not come to rest within deposition.max_time; if a command of the
  /// scenario cannot be carried out, leaving the state as before the step; and if the preceding step exceeded
  /// a guard whose action is to stop: its state is intact and can be inspected, but neither a copy nor a
  /// resumed run can pass it.
  const dynamics::StepReport& advance();

  /// Applies a command before the next step, and records it with the number of steps taken. Friction applies
  /// from then on, including the rest of a deposition; a rate of the tilt set in a deposition is the initial
  /// rate of the tilt. A rate of the tilt, which may be negative, also ends a programme (tilt.program): from
  /// then on the tilt changes at that rate until the run ends, or is held at rate 0. A drag lasts until the
  /// next one, or until it is released. Throws Error(usage), with nothing changed, if check_command or
  /// drop_grains rejects it, if the run is done, for a rate of the tilt after failure, and for a release
  /// without a drag.
  void apply(Command command);

  /// Sets whether the commands of the scenario are carried out, as they are by default; a replay applies the
  /// recorded ones instead.
  void follow_script(bool follows) { follows_script_ = follows; }

  /// Sets the number of threads of the solver; the result does not depend on it.
  void use_threads(int threads) { threads_ = threads; }

  const Scenario& scenario() const { return scenario_; }
  /// Returns the world; its grains keep their addresses in memory while more of them arrive.
  const World& world() const { return world_; }
  const Schedule& schedule() const { return schedule_; }
  Phase phase() const { return schedule_.phase; }
  const dynamics::StepReport& last_report() const { return report_; }
  /// Returns the programme of the tilt in the scenario; empty: the tilt grows.
  const scenario::TiltProgram& program() const { return program_; }
  /// Whether the tilt follows the programme, which a command that sets the rate of the tilt ends.
  bool follows_program() const { return !program_.empty() && !schedule_.course; }
  /// Returns the contact law of the next step.
  dynamics::ContactLawParameters law() const;
  /// Returns the contact law of the last step, by which the present forces are judged.
  dynamics::ContactLawParameters law_of_last_step() const;
  /// Returns the present state in the form in which a run stores it.
  Frame frame() const;
  /// Returns the rate of the tilt, rad/s: that of the scenario, of a command, or of the part of a programme
  /// that the next step belongs to; negative if the tilt decreases, 0 if it is held.
  double tilt_rate() const;
  /// Returns the magnitude of theta_c, rad; no value while the slope has not failed.
  std::optional<double> angle_of_repose() const { return talus::session::angle_of_repose(schedule_); }
  /// Returns the slope of the free surface against the horizontal when the flow after failure has come to
  /// rest, rad; no value before, or if it does not: by 0 deg if the tilt is lowered, within
  /// deposition.max_time if it is held.
  std::optional<double> angle_at_rest() const { return schedule_.angle_at_rest; }

  /// Returns the observables of the current state.
  ObservableRow row() const;
  /// Returns the data recorded since the last call of clear_segment.
  const io::Segment& segment() const { return segment_; }
  void clear_segment() { segment_ = {}; }
  /// Restores the recorded data of a run that returns to an earlier state.
  void restore_segment(io::Segment segment) { segment_ = std::move(segment); }

  /// Returns the remark of bed_of_file on a new run; otherwise empty.
  const std::string& bed_remark() const { return bed_remark_; }

  /// Returns a session with the same state, on one thread, without recorded data.
  Session copy() const;

  /// Returns everything that a resumed run needs. `seconds_writing` goes to the timing.
  io::Checkpoint checkpoint(double seconds_writing) const;

 private:
  /// Values changed before a step, for the case that the step fails.
  struct StepSnapshot {
    std::int64_t step;
    double tilt;
    std::int64_t tilt_steps, flow_steps;
    Vec2 dragged;  ///< velocity of the dragged grain, if any
  };

  dynamics::StepSettings settings() const;
  StepSnapshot snapshot() const;
  void restore(const StepSnapshot& before);
  bool is_quiet() const;  ///< last step slower than deposition.rest_velocity
  bool is_at_rest() const { return schedule_.quiet_steps >= dynamics::rest_steps; }
  bool have_all_arrived() const;
  void take_step();
  void check_guards() const;
  void follow_commands();
  void watch();
  void advance_deposition();
  void begin_tilt();
  void advance_tilt();
  void advance_flow();
  /// Takes a step and tracks the surface layer; returns the velocity of the layer, m/s.
  double take_step_and_follow();
  void reserve_grains();
  /// Records a row of observables and a frame if they are due, or if `row` or `frame` is true.
  void record(bool row, bool frame);
  void record_row();
  bool tilt_is_over() const;  ///< whether it ends at this step, whatever follows

  Scenario scenario_;
  scenario::TiltProgram program_;
  std::string bed_remark_;
  World world_;
  Schedule schedule_;
  std::vector<dynamics::Arrival> arrivals_;  ///< all poured grains; those of the first ids are in the world
  io::Segment segment_;

  int threads_ = 1;
  bool follows_script_ = true;
  dynamics::StepReport report_;
  dynamics::StepWorkspace workspace_;
};

/// Returns the contact law of a scenario after deposition.
dynamics::ContactLawParameters contact_law(const Scenario& scenario);

/// Returns the settings of a step of the tilt of a bed at rest, on one thread.
dynamics::StepSettings step_settings(const Scenario& scenario);

/// Returns the settings of the next step of a world in the tilt, on one thread, with the tolerance for its
/// velocity.
dynamics::StepSettings step_settings(const Scenario& scenario, const World& world);

/// Returns the tilt after the steps of the tilt taken so far, rad.
double scheduled_tilt(const Scenario& scenario, const scenario::TiltProgram& program,
                      const Schedule& schedule);

/// Returns the constants of the run, for all grains, including those that have not arrived yet.
RunStatics run_statics(const Scenario& scenario, const World& world);

/// Magnitude of the tilt at which a run ends if the slope has not failed, deg.
inline constexpr double steepest_tilt = 60.0;

}  // namespace talus::session
