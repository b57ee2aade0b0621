#pragma once
/// A run as a value that is stepped: deposition, rest, tilt, failure, and what follows it. The command line
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

/// The tolerance asked of a step grows with the velocity of the bed, from solver.tolerance at rest to
/// solver.moving_tolerance at an rms velocity of g h: an error of the solver is a velocity too, and stays
/// well below the real one, so that a bed can always come to rest.
class Session {
 public:
  /// A new run: the bed of the scenario before its first step. Throws Error(bad_data) where a command of the
  /// scenario cannot be done to it.
  explicit Session(const scenario::Scenario& scenario);
  /// A run as its last commit left it. Throws Error(bad_data) where the checkpoint lacks a value; `origin` is
  /// what messages call the file, and `group` where the checkpoint stands in it.
  Session(const scenario::Scenario& scenario, io::Checkpoint checkpoint,
          const std::string& origin = "the checkpoint", const std::string& group = "/checkpoint");

  /// Records a row and a frame of the state as it is: those with which a branch of another run begins.
  void record_start();

  /// Takes one step; what it records goes to segment(). Does nothing once done.
  /// Before a step of the tilt, or of the flow after it, commands of the scenario whose angle or time has
  /// come are carried out, as by apply. Throws Error(bad_data) when the bed does not come to rest within
  /// deposition.max_time, where a command of the scenario cannot be carried out, with all as before the step,
  /// and where the step before has broken a guard of the scenario whose action is to stop: its state is
  /// whole, to be looked at, and neither a copy nor a resumed run goes past it.
  const dynamics::StepReport& advance();

  /// Does a command before the next step, and records it with the number of steps taken. Friction holds from
  /// then on, in a deposition for what is left of it as well; a rate of the tilt set in a deposition is that
  /// with which the tilt begins. A rate of the tilt also ends a programme (tilt.program): from then on the
  /// tilt grows at that rate until the slope fails, or is held. A drag goes on until the next one, or until
  /// it is ended. Throws Error(usage), with nothing changed, where check_command or drop_grains refuses it,
  /// once the run is done, and for a rate of the tilt after failure and the end of a drag where there is
  /// none.
  void apply(Command command);

  /// Whether the commands of the scenario are carried out [yes]: not where those that were recorded are.
  void follow_script(bool follows) { follows_script_ = follows; }

  /// Threads of the solver; the result does not depend on them.
  void use_threads(int threads) { threads_ = threads; }

  const scenario::Scenario& scenario() const { return scenario_; }
  /// Its grains stay where they are in memory, also while more of them arrive.
  const World& world() const { return world_; }
  const Schedule& schedule() const { return schedule_; }
  Phase phase() const { return schedule_.phase; }
  const dynamics::StepReport& last_report() const { return report_; }
  /// The course of the tilt that the scenario gives; empty: it grows.
  const scenario::TiltProgram& program() const { return program_; }
  /// Whether the tilt follows it: a command that sets the rate of the tilt ends this.
  bool follows_program() const { return !program_.empty() && !schedule_.course; }
  /// The contact law of the next step.
  dynamics::ContactLawParameters law() const;
  /// rad/s, of the scenario or as a command has set it, or of the part of a programme that the next step
  /// belongs to, below 0 where it lowers the tilt; 0: the tilt is held.
  double tilt_rate() const;
  /// rad, the magnitude of the tilt; no value while the slope has not failed.
  std::optional<double> angle_of_repose() const { return talus::session::angle_of_repose(schedule_); }
  /// Slope of the free surface against the horizontal where the flow after failure has come to rest, rad; no
  /// value before, or where it has not: by 0 deg where the tilt is lowered, within deposition.max_time where
  /// it is held.
  std::optional<double> angle_at_rest() const { return schedule_.angle_at_rest; }

  /// The observables of the state as it is.
  ObservableRow row() const;
  /// What was recorded since the last call of clear_segment.
  const io::Segment& segment() const { return segment_; }
  void clear_segment() { segment_ = {}; }
  /// Puts back what had been recorded of a run that goes back to a state it had.
  void put_back(io::Segment segment) { segment_ = std::move(segment); }

  /// What bed_of_file has to say of a new run; else empty.
  const std::string& bed_remark() const { return bed_remark_; }

  /// The same state, on one thread, with nothing recorded.
  Session copy() const;

  /// All that a resumed run needs. `seconds_writing` goes to the timing.
  io::Checkpoint checkpoint(double seconds_writing) const;

 private:
  /// What is changed ahead of a step, which may turn out not to be possible.
  struct BeforeStep {
    std::int64_t step;
    double tilt;
    std::int64_t tilt_steps, flow_steps;
    Vec2 dragged;  ///< velocity of the grain that is dragged, if any
  };

  dynamics::StepSettings settings() const;
  BeforeStep before_step() const;
  void go_back_to(const BeforeStep& before);
  bool is_quiet() const;  ///< after the last step slower than deposition.rest_velocity
  bool is_at_rest() const { return schedule_.quiet_steps >= dynamics::rest_steps; }
  bool have_all_arrived() const;
  void take_step();
  void refuse_to_pass_a_guard() const;
  void follow_commands();
  void watch();
  void advance_deposition();
  void begin_tilt();
  void advance_tilt();
  void advance_flow();
  /// Takes a step and follows the surface layer in it; returns its velocity, m/s.
  double take_step_and_follow();
  void reserve_grains();
  /// Records a row of observables and a frame where they are due, or where `row` or `frame` is true.
  void record(bool row, bool frame);
  void record_row();
  double scheduled_tilt() const;  ///< rad, after the steps of the tilt taken so far
  bool tilt_is_over() const;      ///< after these steps, whatever follows

  scenario::Scenario scenario_;
  scenario::TiltProgram program_;
  std::string bed_remark_;
  World world_;
  Schedule schedule_;
  std::vector<dynamics::Arrival> arrivals_;  ///< all that are poured; those of the first ids are in the world
  io::Segment segment_;

  int threads_ = 1;
  bool follows_script_ = true;
  dynamics::StepReport report_;
  dynamics::StepWorkspace workspace_;
};

/// The contact law of a scenario, after deposition.
dynamics::ContactLawParameters contact_law(const scenario::Scenario& scenario);

/// A step of the tilt of a bed at rest, on one thread.
dynamics::StepSettings step_settings(const scenario::Scenario& scenario);

/// The next step of a world in the tilt, on one thread: with the tolerance that its velocity asks for.
dynamics::StepSettings step_settings(const scenario::Scenario& scenario, const World& world);

/// rad, after the steps of the tilt taken so far.
double scheduled_tilt(const scenario::Scenario& scenario, const scenario::TiltProgram& program,
                      const Schedule& schedule);

/// What does not change during the run: of all grains, those included that have not arrived yet.
RunStatics run_statics(const scenario::Scenario& scenario, const World& world);

/// A slope that has not failed at this angle ends its run, deg.
inline constexpr double steepest_tilt = 60.0;

}  // namespace talus::session
