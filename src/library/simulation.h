#pragma once
/// A run that a program drives: it is stepped, steered, measured, drawn, recorded and copied. `talus run`
/// steps the same Session, so the same scenario and commands give the same bits, in whatever chunks it is
/// stepped.

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

/// Not for several threads at once; several simulations may run in several threads. A child of fork can look
/// at a simulation of its parent and copy it; Error(usage) where it steps, changes or records it.
class Simulation {
 public:
  /// The bed of the scenario before its first step. `text` is the scenario as it was written, for the header
  /// of a recording; empty: as it is resolved. Throws Error(usage) if it needs more memory than there is.
  explicit Simulation(const scenario::Scenario& scenario, std::string text = {});

  /// A recorded run, where its last commit left it, which goes on in the same file. Throws
  /// Error(missing_input), Error(bad_data), and Error(cannot_create) where another process is at it.
  static Simulation resume(const std::string& path);

  /// A copy of the state, which goes on by itself and is not recorded.
  Simulation(const Simulation& other);
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation) noexcept;
  ~Simulation();

  // Each of these steps until its goal is reached or the run is over (done), and returns false if it was
  // interrupted before. Throws Error(usage) if the run was over already, or where the tilt is held and never
  // gets there; Error(bad_data) if the bed does not come to rest or a guard is broken (Session::advance),
  // with what was computed before kept. What depends on the tilt takes all steps of the deposition as well.

  bool step(std::int64_t count = 1);
  bool deposit();                                      ///< until the bed rests and the tilt begins
  bool tilt_to(double degrees);                        ///< until the tilt is at least that
  bool tilt_by(double degrees);                        ///< until it has grown by that
  bool run(double seconds);                            ///< of simulated time
  bool run_until(const std::function<bool()>& holds);  ///< asked after each step
  bool finish();                                       ///< to the end of the run, which a held tilt has not

  /// Asked between steps, some twenty times a second: true interrupts what is stepping. An exception that it
  /// throws goes through, between two steps.
  void interrupt_if(std::function<bool()> interrupts);
  /// Threads of the solver [1]; the result does not depend on them.
  void use_threads(int threads);

  // Commands: recorded, and repeated by talus replay. Throw Error(usage), with nothing changed, as
  // Session::apply does.

  void push(Index grain, Vec2 velocity);  ///< adds to its velocity, m/s
  void push(const std::vector<Index>& grains, const std::vector<Vec2>& velocities);  ///< all of them, or none
  void drop(Index grains, double x, double height);  ///< from the free surface onto x (m), from a height (m)
  void drag(Index grain, Vec2 to);                   ///< by a spring, m
  void release();
  void set_friction(double friction);
  void set_tilt_rate(double degrees_per_second);  ///< 0: the tilt is held

  // Where it stands.

  const scenario::Scenario& scenario() const;
  const World& world() const;  ///< grains and contacts after the last step; stays where it is
  session::Phase phase() const;
  bool done() const;
  double tilt() const;       ///< deg
  double tilt_rate() const;  ///< deg/s
  double friction() const;   ///< between grains
  double residual() const;   ///< eta of the last step (docs/solver.md)
  bool converged() const;    ///< whether the last step reached its tolerance
  std::string state_hash() const;
  std::optional<double> theta_c() const;  ///< deg; nothing while the slope has not failed

  // Measures of the state as it is, as MeasuredFrame has them.

  /// Parameters of the analysis, as `talus analyze --set` takes them: "l_min=0", "gamma_c=0.3".
  void set_analysis(const std::vector<std::string>& settings);
  double quantity(std::string_view name);
  std::vector<double> grain_values(std::string_view name);
  std::vector<double> contact_values(std::string_view name);
  render::Image draw(const std::string& map, pictures::MapOptions options = {});
  /// The state as a run records it.
  const Frame& frame();
  const RunStatics& statics() const;

  // Recording.

  /// From now on what happens is recorded as a run: an ordinary one before the first step, and after the
  /// deposition one that branches off from the state as it is. Throws Error(cannot_create), and Error(usage)
  /// if it is recorded already.
  void record(const std::string& path, bool overwrite = false);
  bool recorded() const;
  /// Writes the state as it is as a run of its own, which can be resumed. Throws as record does.
  void save(const std::string& path, bool overwrite = false) const;
  /// Makes all that was recorded durable. It is done at each frame, at the end, and when the simulation goes.
  /// Once the run is over, this packs it where that has failed before, on a full disk.
  void commit();

 private:
  struct State;
  explicit Simulation(std::unique_ptr<State> state);
  bool advance_until(const std::function<bool(const session::Session&)>& reached);
  void apply(const Command& command);
  std::unique_ptr<State> state_;
};

}  // namespace talus
