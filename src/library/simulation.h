#pragma once
/// A run controlled by a program, which steps, steers, measures, draws, records and copies it. `talus run`
/// steps the same Session, so the same scenario and commands give bit-identical results, however the steps
/// are divided among calls.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/command.h"
#include "core/snapshot.h"
#include "core/world.h"
#include "pictures/map_options.h"
#include "render/image.h"
#include "scenario/scenario.h"
#include "session/phase.h"

namespace talus::session {
class Session;
}

namespace talus {

class MeasuredFrame;

/// A simulation must be used by one thread at a time; different simulations may run in different threads. A
/// forked child may inspect and copy a simulation of its parent; stepping, changing or recording it throws
/// Error(usage).
class Simulation {
 public:
  /// Creates the bed of the scenario before its first step. `text` is the original text of the scenario, for
  /// the header of a recording; if it is empty, the resolved scenario is used. Throws Error(usage) if the
  /// available memory is insufficient.
  explicit Simulation(const scenario::Scenario& scenario, std::string text = {});

  /// Resumes a recorded run at its last commit, in the same file. Throws Error(missing_input), Error(usage)
  /// if the run is complete, Error(bad_data), and Error(cannot_create) if another process is writing to it.
  static Simulation resume(const std::string& path);

  /// Copies the state. The copy is independent and is not recorded.
  Simulation(const Simulation& other);
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation) noexcept;
  ~Simulation();

  // The following functions step until the goal is reached or the run is over (done), and return false if
  // they were interrupted before. They throw Error(usage) if the run was over already, if the course of the
  // tilt never reaches the goal (session::why_never), or for a time below 0, and Error(bad_data) if
  // the bed does not come to rest or a guard is broken (Session::advance); steps computed before the error
  // are kept. Functions that depend on the tilt first complete the deposition.

  /// Takes `count` steps.
  bool step(std::int64_t count = 1);
  bool deposit();  ///< until the bed is at rest and the tilt begins
  /// Steps until the tilt passes this angle, from below or from above. A tilt that leads away from the angle
  /// is turned first, by a command that sets its rate with the other sign; a programme is followed. An angle
  /// that the tilt has passed by less than one step counts as reached.
  bool tilt_to(double degrees);
  /// tilt_to, relative to the goal of the call before if no step was taken and no rate was set since; else to
  /// the present tilt.
  bool tilt_by(double degrees);
  /// Steps for a duration of simulated time, steps_in(seconds).
  bool run(double seconds);
  /// Returns the number of steps in a duration. The rest, at most half a step, is carried over to the next
  /// call. Throws Error(usage) for less than half a step, unless what was carried over completes one.
  std::int64_t steps_in(double seconds);
  bool run_until(const std::function<bool()>& holds);  ///< evaluated after each step
  bool finish();                                       ///< until the end of the run; a held tilt has none

  /// Sets a callback that is called between steps, about twenty times a second; it returns true to interrupt
  /// the function that is stepping. Its exceptions propagate between two steps.
  void interrupt_if(std::function<bool()> interrupts);
  /// Sets the number of threads of the solver (default 1); the result does not depend on it.
  void use_threads(int threads);

  // Commands. They are recorded, and repeated by talus replay. They throw Error(usage), without changing
  // anything, as Session::apply does.

  void push(Index grain, Vec2 velocity);  ///< adds to the velocity, m/s
  /// Pushes all of these grains, or none.
  void push(const std::vector<Index>& grains, const std::vector<Vec2>& velocities);
  /// Drops grains of the free surface onto x (m) from a height (m).
  void drop(Index grains, double x, double height);
  void drag(Index grain, Vec2 to);  ///< drags a grain by a spring held at this point, m
  /// Releases the dragged grain.
  void release();
  /// Sets the coefficient of friction between grains.
  void set_friction(double friction);
  void set_tilt_rate(double degrees_per_second);  ///< negative: downwards; 0 holds the tilt

  // State.

  const scenario::Scenario& scenario() const;
  const World& world() const;  ///< grains and contacts after the last step; the reference remains valid
  session::Phase phase() const;
  bool done() const;
  double tilt() const;       ///< deg, rounded to 1e-9
  double tilt_rate() const;  ///< deg/s, rounded to twelve digits
  double friction() const;   ///< coefficient between grains
  /// Return eta of the last step (docs/solver.md) and whether it reached its tolerance; empty before the
  /// first step, and after the resumption of a run that an earlier version wrote.
  std::optional<double> residual() const;
  std::optional<bool> converged() const;
  std::string state_hash() const;
  std::optional<double> theta_c() const;  ///< deg, rounded to 1e-9; empty if the slope has not failed

  // Measurements of the present state, as in MeasuredFrame.

  /// Sets parameters of the analysis, as `talus analyze --set` does: "l_min=0", "gamma_c=0.3".
  void set_analysis(const std::vector<std::string>& settings);
  /// Returns the present state as a frame that is measured; it is valid until the next step or command.
  MeasuredFrame& measured();
  /// Return measured quantities as the functions of MeasuredFrame do.
  double quantity(std::string_view name);
  std::vector<double> grain_values(std::string_view name);
  std::vector<double> contact_values(std::string_view name);
  render::Image draw(const pictures::MapChoice& what, const pictures::MapOptions& options = {});
  /// Returns the state in the form in which a run stores it.
  const Frame& frame();
  const RunStatics& statics() const;

  // Recording.

  /// Starts recording the simulation as a run: before the first step as an ordinary run, after the deposition
  /// as one that branches off from the present state. Creates the folder of the run if missing. Throws
  /// Error(cannot_create), and Error(usage) if it is being recorded already.
  void record(const std::string& path, bool overwrite = false);
  bool recorded() const;
  /// Writes the present state as a separate run that can be resumed. Throws as record does.
  void save(const std::string& path, bool overwrite = false) const;
  /// Makes all recorded data durable. This also happens at each frame, at the end of the run, and when the
  /// simulation is destroyed. After the end of the run, it also packs the file if that failed earlier, for
  /// example because the disk was full.
  void commit();

 private:
  struct State;
  explicit Simulation(std::unique_ptr<State> state);
  bool advance_until(const std::function<bool(const session::Session&)>& reached);
  void apply(const Command& command);
  std::unique_ptr<State> state_;
};

}  // namespace talus
