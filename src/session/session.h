#pragma once
/// A run as a value that is stepped: deposition, rest, tilt, failure, and what follows it. The command line
/// and the interactive frontend are both thin clients of it.

#include <array>
#include <cstdint>
#include <optional>

#include "dynamics/failure.h"
#include "dynamics/step.h"
#include "io/run_store.h"
#include "session/command.h"
#include "session/deposition.h"
#include "session/guards.h"
#include "session/measure.h"
#include "session/scenario.h"

namespace talus {

/// Flow: what follows failure where the scenario asks for it (tilt.after_failure), until the bed is at rest.
enum class Phase : std::int64_t { deposition = 0, tilt = 1, done = 2, flow = 3 };

/// How well the steps of the tilt were solved so far.
struct SolverRecord {
  std::int64_t unconverged_deposition = 0;  ///< steps that did not reach the tolerance asked of them
  std::int64_t unconverged_tilt = 0;
  std::int64_t unconverged_flow = 0;
  double residual_max_rest = 0.0;    ///< worst eta of a step of the tilt at rest
  double residual_max_moving = 0.0;  ///< worst eta of the other steps of the tilt
};

/// A tilt whose rate a command has changed: from then on `rate` h a step.
struct TiltCourse {
  double rate = 0.0;       ///< deg/s
  double from = 0.0;       ///< rad, the tilt when the rate was changed
  std::int64_t since = 0;  ///< steps of the tilt taken by then
};

class StoredValues;

/// The tolerance asked of a step grows with the velocity of the bed, from solver.tolerance at rest to
/// solver.moving_tolerance at an rms velocity of g h: an error of the solver is a velocity too, and stays
/// well below the real one, so that a bed can always come to rest.
class Session {
 public:
  /// A new run: the bed of the scenario before its first step.
  explicit Session(const Scenario& scenario);
  /// A run as its last commit left it. Throws Error(bad_data) where the checkpoint lacks a value; `origin` is
  /// what messages call the file.
  Session(const Scenario& scenario, Checkpoint checkpoint, const std::string& origin = "the checkpoint");

  /// Takes one step; what it records goes to segment(). Does nothing once done.
  /// Throws Error(bad_data) when the bed does not come to rest within deposition.max_time, and
  /// Error(internal) where the step before has broken a guard of the scenario whose action is to stop: its
  /// state is whole, to be looked at.
  const StepReport& advance();

  /// Does a command before the next step, and records it with the number of steps taken. Friction holds from
  /// then on, in a deposition for what is left of it as well; a rate of the tilt set in a deposition is that
  /// with which the tilt begins. Throws Error(usage), with nothing changed, where check_command or
  /// drop_grains refuses it, once the run is done, and for a rate of the tilt after failure.
  void apply(Command command);

  /// Threads of the solver; the result does not depend on them.
  void use_threads(int threads) { threads_ = threads; }

  const Scenario& scenario() const { return scenario_; }
  const World& world() const { return world_; }
  Phase phase() const { return phase_; }
  const StepReport& last_report() const { return report_; }
  const SolverRecord& solver_record() const { return record_; }
  const GuardWarnings& guard_warnings() const { return guard_warnings_; }
  /// The contact law of the next step.
  ContactLawParameters law() const;
  /// deg/s, of the scenario or as a command has set it; 0: the tilt is held.
  double tilt_rate() const { return course_ ? course_->rate : scenario_.tilt.rate; }
  /// rad; no value while the slope has not failed.
  std::optional<double> angle_of_repose() const;
  /// Slope of the free surface against the horizontal where the flow after failure has come to rest, rad; no
  /// value before, or where it has not: by 0 deg where the tilt is lowered, within deposition.max_time where
  /// it is held.
  std::optional<double> angle_at_rest() const { return angle_at_rest_; }

  /// What was recorded since the last call of clear_segment.
  const Segment& segment() const { return segment_; }
  void clear_segment() { segment_ = {}; }

  /// All that a resumed run needs. `seconds_writing` goes to the timing.
  Checkpoint checkpoint(double seconds_writing) const;

 private:
  StepSettings settings() const;
  bool is_quiet() const;  ///< slower than deposition.rest_velocity
  bool is_at_rest() const { return quiet_steps_ >= rest_steps; }
  bool have_all_arrived() const;
  void take_step();
  void watch();
  void advance_deposition();
  void begin_tilt();
  void advance_tilt();
  void advance_flow();
  /// Takes a step and follows the surface layer in it; returns its velocity, m/s.
  double take_step_and_follow();
  /// Records a row of observables and a frame where they are due, or where `row` or `frame` is true.
  void record(bool row, bool frame);
  void record_row();
  double scheduled_tilt() const;  ///< rad, after tilt_steps_ steps
  void add_commanded(Checkpoint& checkpoint) const;
  void take_commanded(const StoredValues& stored);
  void add_warnings(Checkpoint& checkpoint) const;
  void take_warnings(const Checkpoint& checkpoint);
  void add_flow(Checkpoint& checkpoint) const;
  void take_flow(const StoredValues& stored);

  Scenario scenario_;
  World world_;
  std::vector<Arrival> arrivals_;  ///< all that are poured; those of the first ids are in the world
  Phase phase_ = Phase::deposition;
  std::int64_t tilt_steps_ = 0;
  std::int64_t flow_steps_ = 0;
  std::int64_t quiet_steps_ = 0;  ///< in a row, until now
  Baseline baseline_;
  std::optional<double> friction_;    ///< set by a command
  std::optional<TiltCourse> course_;  ///< set by a command
  SurfaceFlow flow_;
  std::optional<double> angle_at_rest_;
  double surface_height_ = 0.0;        ///< m, mean free surface at the last row
  double surface_displacement_ = 0.0;  ///< m
  double residual_since_row_ = 0.0;
  SolverRecord record_;
  std::int64_t unconverged_in_a_row_ = 0;
  GuardWarnings guard_warnings_;
  std::string broken_guard_;  ///< why the next step is not taken
  std::array<double, stage_count> stage_seconds_{};
  double deposition_seconds_ = 0.0;
  double tilt_seconds_ = 0.0;

  int threads_ = 1;
  StepReport report_;
  StepWorkspace workspace_;
  Segment segment_;
};

/// The contact law of a scenario, after deposition.
ContactLawParameters contact_law(const Scenario& scenario);

/// A step of the tilt of a bed at rest, on one thread.
StepSettings step_settings(const Scenario& scenario);

/// The next step of a world in the tilt, on one thread: with the tolerance that its velocity asks for.
StepSettings step_settings(const Scenario& scenario, const World& world);

/// What does not change during the run: of all grains, those included that have not arrived yet.
RunStatics run_statics(const Scenario& scenario, const World& world);

/// A slope that has not failed at this angle ends its run, deg.
inline constexpr double steepest_tilt = 60.0;

}  // namespace talus
