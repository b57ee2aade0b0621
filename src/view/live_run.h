#pragma once
/// A run that is computed while it is looked at: the session steps in a thread of its own, and what is shown
/// is a copy.

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

namespace talus::view {

/// How fast a run goes on, at most.
struct LivePace {
  const char* name;      ///< "real time"
  double tilt = 0.0;     ///< deg of tilt in a second of the clock; a bed that is not tilted is as with 0
  double seconds = 0.0;  ///< simulated, in a second of the clock; both 0: as fast as it can be computed
};
/// Those that are offered, in order.
inline constexpr LivePace live_paces[] = {
    {"fastest"},     {"real time", 0.0, 1.0}, {"0.1°/s", 0.1}, {"0.2°/s", 0.2},
    {"0.5°/s", 0.5}, {"1°/s", 1.0},           {"2°/s", 2.0},   {"5°/s", 5.0}};

/// What the solver's thread has to say, a copy that does not change.
struct LiveStatus {
  std::int64_t step = 0;
  double time = 0.0;  ///< s
  double tilt = 0.0;  ///< rad
  bool depositing = false;
  bool running = false;            ///< false: waiting for play or step
  bool done = false;               ///< the run has ended: failed, or at its end angle
  std::optional<double> theta_c;   ///< rad
  double steps_per_second = 0.0;   ///< over the last second or so
  double tilt_rate = 0.0;          ///< deg/s, as it is now
  double friction = 0.0;           ///< between grains, as it is now
  std::optional<Index> dragged;    ///< the grain that is being dragged
  std::size_t commands_given = 0;  ///< before which the run can go back, see back
  std::string state_hash;          ///< of the state after `step` steps; empty while running
  std::string error;               ///< what went wrong, as one line; play, step and run_to try again
  ExitCode error_code = ExitCode::internal;  ///< of `error`
};

/// All members may be called from one thread, which is not the solver's. While a run is recorded, the
/// solver's thread writes files: no other may read or write HDF5 (RunFile) meanwhile, but after halt.
class LiveRun {
 public:
  /// Begins the run of a scenario, paused before its first step. With an `output`, it is recorded as `talus
  /// run` records it, with its commands; `overwrite` as there. Without, all of it is kept in memory. With a
  /// `branch` it begins with that frame. Throws as RunStore::create.
  LiveRun(const scenario::Scenario& scenario, const std::string& scenario_text, const std::string& output,
          bool overwrite, const std::string& command_line,
          const std::optional<io::BranchOrigin>& branch = {});
  /// Finishes the step under way, commits what there is, and ends. A run that is done is packed.
  ~LiveRun();
  LiveRun(const LiveRun&) = delete;
  LiveRun& operator=(const LiveRun&) = delete;

  void play();
  void pause();
  void step(std::int64_t count);        ///< so many steps, then pause
  void run_to(double tilt);             ///< rad: plays until the tilt is reached, then pauses
  void finish_deposition();             ///< plays until the tilt begins, then pauses
  void set_pace(const LivePace& pace);  ///< from the next step on
  /// Pauses, and returns when the solver rests: from then on it touches no file until it is asked to go on.
  void halt();
  /// Applies a command before the next step, and returns when that is done; its step number is filled in.
  /// Throws as Session::apply: Error(usage) for no such grain, a value that is not finite or out of range, a
  /// run that is done.
  void apply(Command command);
  /// Pauses, and takes back the last command that was given, with all that came after it: the state is that
  /// before it, to the last bit; of a drag, that before it was begun. Up to 64 commands can be taken back,
  /// one after another. What a run has recorded stays in its file as it was; the run goes on in `output`,
  /// from its beginning, where nothing is taken for one that is not recorded. Throws Error(usage) where there
  /// is no such command, and as RunStore::create.
  void back(const std::string& output);
  /// Records a run that is not recorded yet, from its beginning, and returns when that is on disk. Throws as
  /// RunStore::create, and Error(usage) where it is recorded already.
  void record(const std::string& output, bool overwrite);
  /// Commits a checkpoint, and returns when that is done; does nothing without an output. Where it fails, the
  /// status says so.
  void save();

  const RunStatics& statics() const;
  LiveStatus status() const;
  /// The newest state of the bed, a new one about every 1/30 s while running, and at once when it pauses.
  /// Never null.
  std::shared_ptr<const Frame> frame() const;
  /// Rows of observables recorded since `from` rows, in order.
  std::vector<ObservableRow> observables(std::size_t from) const;
  /// Frames as the run records them (output.frame_every), since `from` of them.
  std::vector<std::shared_ptr<const Frame>> recorded_frames(std::size_t from) const;
  /// Rows of single steps, thinned to at most 4000 at equal distances; since `from`. Each time there are
  /// more, every second is left out: then there are fewer than before, and they are to be taken anew from 0.
  std::vector<StepRow> steps(std::size_t from) const;
  std::vector<Command> commands() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace talus::view
