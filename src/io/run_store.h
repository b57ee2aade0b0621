#pragma once
/// Writes a run. While it is computed, a run is a folder `PATH.run/`; at the end it is packed into one
/// self-contained HDF5 file `PATH` (docs/file_format.md).

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/command.h"
#include "core/observables.h"
#include "core/snapshot.h"

namespace talus::analysis {
struct Analysis;
}

namespace talus::io {

/// The data needed to continue with identical bits: the world in doubles, and the state of the schedule as
/// named values that the session interprets. `results` are the results of the run so far (theta_c, ...), and
/// `timing` the seconds spent in each stage.
struct Checkpoint {
  World world;
  std::vector<std::pair<std::string, std::int64_t>> integers;
  Figures reals;
  Figures results;
  Figures timing;
};

/// The origin of a run that begins with a frame of another one.
struct BranchOrigin {
  std::string run;         ///< path that the user gave
  std::int64_t frame = 0;  ///< frame of that run, from 0
  std::string run_hash;    ///< state hash of its end at that time
  Checkpoint start;        ///< state from which the branch continues, without results and timing
  std::string history{};   ///< departures of the run before the frame, kept in the provenance
};

/// Name of the history of a branch in the provenance.
inline constexpr const char* history_fact = "history";

/// Data known when a run begins.
struct RunHeader {
  RunStatics statics;
  Friction friction;              ///< friction of the scenario, after the deposition
  Friction deposition_friction;   ///< friction of the scenario, until the bed is at rest
  std::string scenario_given;     ///< TOML as the user wrote it
  std::string scenario_resolved;  ///< TOML with every key
  std::uint64_t seed = 0;
  Facts provenance;  ///< version, git_hash, compiler, flags, host, threads, argv, start, ...
  std::optional<BranchOrigin> branch{};
};

/// Data recorded since the last commit.
struct Segment {
  std::vector<Frame> frames;
  std::vector<ObservableRow> observables;
  std::vector<StepRow> steps;
  std::vector<Command> commands;
  std::vector<TrialRow> trials;
};

/// The integer that a run with a programme of the tilt has: the number of steps when the last step of the
/// tilt was taken. The tilt need not be highest there.
inline constexpr const char* last_tilt_step_name = "last_tilt_step";
inline constexpr const char* flow_steps_name = "flow_steps";

/// Values of an analysis with other parameters: a row for each threshold, a column for each quantity.
struct StoredReading {
  std::string name;  ///< for example "l_min=0,min_contacts=3"
  std::string key;   ///< key of the analysis
  std::size_t thresholds = 0;
  std::vector<double> values;
  std::vector<std::int8_t> at_most;  ///< 1 if the value is only an upper bound
};

/// The optional parts of a packed file.
struct PackedParts {
  const analysis::Analysis* analysis = nullptr;  ///< stored with the run, unless null
  std::vector<StoredReading> readings = {};      ///< stored with the analysis, if there is one
  bool frames = true;                            ///< false: only steps, times and tilts of frames
};

/// The open folder of a run being computed, locked against other writers.
class RunStore {
 public:
  /// Begins a new run, in a folder that is created if missing. Throws Error(usage) if `path` is not the name
  /// of a run (require_run_name); Error(cannot_create) if `path` or its folder exists, unless `overwrite`; if
  /// another process holds the lock; or if `path` cannot be replaced (output_target). The run exists from its
  /// first commit on, and leftovers of a kill before that are removed here. A packed file that is overwritten
  /// is kept until pack has completed the new one, a folder until the first commit.
  static RunStore create(const std::string& path, const RunHeader& header, bool overwrite);

  /// Opens the folder of an interrupted run and reads its last checkpoint. Throws the errors of create,
  /// Error(missing_input) if there is no such folder, and Error(bad_data) if its contents are damaged.
  static RunStore resume(const std::string& path, RunHeader& header, Checkpoint& checkpoint);

  RunStore(RunStore&&) noexcept;
  RunStore& operator=(RunStore&&) noexcept;
  ~RunStore();

  /// Makes a segment and a checkpoint durable, atomically: after a kill at any instant the folder contains
  /// either this entire commit or nothing of it. Throws Error(io_error), and Error(cannot_create) if the
  /// folder was removed or replaced.
  void commit(const Segment& segment, const Checkpoint& checkpoint);

  /// Packs everything committed into a file, which is renamed to `path` once it has proved readable, removes
  /// the folder, and ends the store. Calls `should_continue`, if given, before each frame, and stops if that
  /// returns false; pack then returns false too. In that case, and if pack throws, the folder is kept, and
  /// pack can be called again.
  bool pack(const std::function<bool()>& should_continue = {}, const PackedParts& parts = {});

  /// Returns the seconds spent in commit so far.
  double seconds_writing() const;

 private:
  struct State;
  explicit RunStore(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// The form of the run at `path`: a packed file, a folder with something committed (and no packed file, or
/// that of an earlier run which it replaces), or neither.
enum class RunPresence { none, folder, packed };
RunPresence run_presence(const std::string& path);

/// Removes the folder of a run that is already packed, which a kill at the end of packing can leave; a folder
/// with another run only if `of_any_run`. Throws Error(cannot_create) if another process uses it.
void discard_folder(const std::string& path, bool of_any_run = false);

/// Returns the damage of a packed file, as detected by its seal; empty if it is undamaged, gone, or of a
/// later format. Throws Error(missing_input).
std::string damage_of_packed(const std::string& path);

/// Moves a run aside that cannot be used, because its file is damaged, or because the manifest of its folder
/// is damaged or does not match the files. The file or folder is renamed to `path`.damaged, with a number
/// from the second one on. Returns a description of the damage and the new location; nothing if the run is
/// undamaged. Throws Error(cannot_create) if another process uses it, or if it cannot be renamed.
std::string set_damaged_aside(const std::string& path);

/// Moves a folder aside to make way for another run of that name: it is renamed to `path`.withdrawn, with a
/// number from the second one on. Throws the errors of set_damaged_aside.
void set_withdrawn_aside(const std::string& path);

/// Returns the folder in which the run `path` is computed, and the run of such a folder (RUN.h5 for
/// RUN.h5.run/) or of its own name.
std::string run_folder(const std::string& path);
std::string run_of_folder(std::string folder);

/// Throws because a run was expected at `path`: Error(missing_input) if nothing is there, or a folder that is
/// not a run; Error(bad_data) if it is a file of another kind.
[[noreturn]] void refuse_no_run(const std::string& path);

/// Throws Error(usage) if a run that is to be written would have the name of another kind of file, such as
/// run.txt. Names that end in .h5, with a number such as mu-0.3 or run.v2, or without an ending are those of
/// runs.
void require_run_name(const std::string& path);

/// Throws Error(bad_data) if `path`, where a scenario is expected, is a run, complete or not.
/// Returns for everything else, which the parser of scenarios reports.
void refuse_no_scenario(const std::string& path);

// Bounds of a bed that can be stored: code that reads a run uses its values as sizes of grids and indices.
// Reader and writer of runs apply the same.

/// Whether what is written is checked; only tests that make invalid runs clear it.
inline bool checks_what_is_written = true;

/// Radii of grains, mean diameters.
inline constexpr double smallest_radius = 1e-3, largest_radius = 1e3;

/// Returns the largest valid distance of a grain or contact from the origin along either axis, m. Divided
/// into cells of the size of a grain, it must still be a valid number of cells.
inline double farthest_place(double length, double depth, double mean_diameter) {
  return std::min(1e4 * (length + depth), 1e8 * mean_diameter);
}
inline double farthest_place(const RunStatics& statics) {
  return farthest_place(statics.length, statics.depth, statics.mean_diameter);
}

}  // namespace talus::io
