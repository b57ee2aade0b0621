#pragma once
/// A run that is computed while it is shown: the session steps in its own thread, and the view shows a copy.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/errors.h"
#include "core/observables.h"
#include "core/snapshot.h"
#include "io/run_store.h"
#include "scenario/scenario.h"
#include "session/command.h"
#include "view/frame_source.h"

namespace talus::view {

/// Upper limit on the speed of a run.
struct LivePace {
  const char* name;   ///< "real time"
  double tilt = 0.0;  ///< degrees of tilt per second of wall time; a bed that is not tilted behaves as with 0
  double seconds = 0.0;  ///< simulated seconds per second of wall time; if both are 0, as fast as possible
};
/// Available paces, in order.
inline constexpr LivePace live_paces[] = {
    {"fastest"},     {"real time", 0.0, 1.0}, {"0.1°/s", 0.1}, {"0.2°/s", 0.2},
    {"0.5°/s", 0.5}, {"1°/s", 1.0},           {"2°/s", 2.0},   {"5°/s", 5.0}};

/// Steps of a run or a branch, and how well they were solved.
struct SolvedSteps {
  std::int64_t count = 0, unconverged = 0;
  std::optional<StepRow> last;  ///< empty before the first step
};

/// Report of the solver's thread: a copy that does not change.
struct LiveStatus {
  std::int64_t step = 0;
  double time = 0.0;  ///< s
  double tilt = 0.0;  ///< rad
  bool depositing = false;
  bool running = false;           ///< false: waiting for play or step
  bool done = false;              ///< the run has failed or reached its final angle
  std::optional<double> theta_c;  ///< rad
  double steps_per_second = 0.0;  ///< averaged over about the last second
  double tilt_rate = 0.0;         ///< deg/s, current value
  double friction = 0.0;          ///< between grains, current value
  SolvedSteps solved{};
  std::optional<Index> dragged;              ///< grain being dragged
  std::size_t commands_given = 0;            ///< commands that back() can undo
  std::string state_hash;                    ///< hash of the state after `step` steps; empty while running
  std::string error;                         ///< error as one line; play, step and run_to try again
  ExitCode error_code = ExitCode::internal;  ///< exit code of `error`
};

/// A live run; its frames are those recorded (output.frame_every). All members but those of a FrameSource
/// must be called from one thread other than the solver's. While a run is recorded, the solver's thread
/// writes files: no other thread may read or write HDF5 (RunFile) until halt() has returned.
class LiveRun final : public FrameSource {
 public:
  /// Begins the run of a scenario, paused before its first step. With an `output`, the run is recorded
  /// together with its commands, as `talus run` records it, and `overwrite` has the same meaning; without, it
  /// is kept in memory. With a `branch`, it begins with that frame. Throws as RunStore::create does.
  LiveRun(const scenario::Scenario& scenario, const std::string& scenario_text, const std::string& output,
          bool overwrite, const std::string& command_line,
          const std::optional<io::BranchOrigin>& branch = {});
  /// Finishes the current step, commits, and ends. A finished run is packed.
  ~LiveRun() override;

  void play();
  void pause();
  void step(std::int64_t count);  ///< runs this many steps, then pauses
  /// Runs until the tilt (rad) is passed, then pauses; turns a tilt that leads away from it by a command
  /// first. Throws Error(usage) if its course never gets there (session::why_never).
  void run_to(double tilt);
  void finish_deposition();             ///< runs until the tilt begins, then pauses
  void set_pace(const LivePace& pace);  ///< takes effect at the next step
  /// Pauses, and returns once the solver rests and accesses no file.
  void halt();
  /// Applies a command before the next step, and returns when that is done; sets the command's step number.
  /// Throws as Session::apply does: Error(usage) if the grain does not exist, a value is not finite or out of
  /// range, or the run has ended.
  void apply(Command command);
  /// Pauses and undoes the last command with everything after it. The state is bit-identical to that before
  /// the command; a drag is undone as a whole. Up to 64 commands can be undone, one after another. The file
  /// of a recorded run stays as it was; the run is recorded again, from its beginning, in `output`, which is
  /// ignored for a run that is not recorded. Throws Error(usage) if there is no command to undo, and as
  /// RunStore::create does.
  void back(const std::string& output);
  /// Starts to record a run that is not recorded yet, from its beginning, and returns when the data are on
  /// disk. Throws as RunStore::create does, and Error(usage) if the run is already recorded.
  void record(const std::string& output);
  /// Commits a checkpoint, if there is an output, and returns when that is done. The status has a failure.
  void save();

  const RunStatics& statics() const;
  LiveStatus status() const;
  /// Returns the newest state of the bed, updated every 1/30 s, and when the run pauses. Never null.
  std::shared_ptr<const Frame> newest() const;
  std::shared_ptr<const Frame> read(std::size_t k) override;
  /// Adds what has been recorded since the last call to the frames.
  void take_frames();
  /// Returns the recorded rows of observables from row `from` on, in order.
  std::vector<ObservableRow> observables(std::size_t from) const;
  std::vector<Command> commands() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace talus::view
