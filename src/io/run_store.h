#pragma once
/// Writing a run. While it computes, a run is a folder `PATH.run/`; at the end it is packed into one
/// self-sufficient HDF5 file `PATH` (docs/file_format.md).

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/command.h"
#include "core/snapshot.h"
#include "core/trial_row.h"

namespace talus::analysis {
struct Analysis;
}

namespace talus::io {

/// All that is needed to continue with the same bits: the world in doubles, and the state of the schedule as
/// named values that the session understands. `results` are the figures of the run so far (theta_c, ...),
/// `timing` the seconds spent in each stage.
struct Checkpoint {
  World world;
  std::vector<std::pair<std::string, std::int64_t>> integers;
  Figures reals;
  Figures results;
  Figures timing;
};

/// Of a run that begins with a frame of another one.
struct BranchOrigin {
  std::string run;         ///< as the user named it
  std::int64_t frame = 0;  ///< of that run, from 0
  std::string run_hash;    ///< the state hash of its end, as it then was
  Checkpoint start;        ///< from which the branch follows; without results and timing
};

/// What is known when a run begins.
struct RunHeader {
  RunStatics statics;
  std::string scenario_given;     ///< TOML as the user wrote it
  std::string scenario_resolved;  ///< TOML with every key
  std::uint64_t seed = 0;
  Facts provenance;  ///< version, git_hash, compiler, flags, host, threads, argv, start, ...
  std::optional<BranchOrigin> branch{};
};

/// What has happened since the last commit.
struct Segment {
  std::vector<Frame> frames;
  std::vector<ObservableRow> observables;
  std::vector<StepRow> steps;
  std::vector<Command> commands;
  std::vector<TrialRow> trials;
};

/// The integer that a run with a programme of the tilt has: steps of the world when the last step of the tilt
/// was taken. Its tilt need not be highest there.
inline constexpr const char* last_tilt_step_name = "last_tilt_step";

/// Values that another analysis than the stored one gave: a row for each threshold, a column for each
/// quantity.
struct StoredReading {
  std::string name;  ///< "l_min=0,min_contacts=3"
  std::string key;   ///< of the analysis
  std::size_t thresholds = 0;
  std::vector<double> values;
  std::vector<std::int8_t> at_most;  ///< 1 where no more is known than that it is not above the value
};

/// What a packed file holds besides all that was committed, and what not.
struct PackedParts {
  const analysis::Analysis* analysis = nullptr;  ///< stored with the run, if there is one
  std::vector<StoredReading> readings = {};      ///< the same, where there is an analysis
  bool frames = true;                            ///< false: only with steps, times and tilts of its frames
};

/// The open folder of a running run, locked against other writers.
class RunStore {
 public:
  /// A new run. Throws Error(cannot_create) where `path` or its folder exists, unless `overwrite`, where
  /// another process holds the lock, or where `path` is anything but a file that may be replaced
  /// (output_target). The run exists from its first commit on: what a kill leaves before that is cleared away
  /// here. A packed file that is overwritten stays until pack has the new one whole, a folder until the first
  /// commit.
  static RunStore create(const std::string& path, const RunHeader& header, bool overwrite);

  /// The folder of an interrupted run, and its last checkpoint. Throws as create does, Error(missing_input)
  /// where there is no such folder, and Error(bad_data) where what is there is damaged.
  static RunStore resume(const std::string& path, RunHeader& header, Checkpoint& checkpoint);

  RunStore(RunStore&&) noexcept;
  RunStore& operator=(RunStore&&) noexcept;
  ~RunStore();

  /// Makes a segment and a checkpoint durable, both or neither. After a kill at any instant the folder holds
  /// either all of this commit or nothing of it. Throws Error(io_error), and Error(cannot_create) where the
  /// folder has been removed or replaced.
  void commit(const Segment& segment, const Checkpoint& checkpoint);

  /// Packs everything committed into the file at `path`, which gets its name once it can be read, and removes
  /// the folder. Ends the store. Asks before each frame whether it `goes_on`; returns false where it does
  /// not. Then, and where it throws, the folder is kept, and pack can be called again.
  bool pack(const std::function<bool()>& goes_on = {}, const PackedParts& parts = {});

  /// Seconds spent in commit so far.
  double seconds_writing() const;

 private:
  struct State;
  explicit RunStore(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Whether `path` is a packed run file, a run folder with something committed (and no packed file yet, or
/// that of an earlier run which it replaces), or neither.
enum class RunPresence { none, folder, packed };
RunPresence run_presence(const std::string& path);

/// Removes the folder of a run that is packed already, which a kill at the end of packing leaves. Throws
/// Error(cannot_create) where another process is at it.
void discard_folder(const std::string& path);

/// What is damaged of a packed file, by its seal; empty where it is whole, gone, or of a later format. Throws
/// Error(missing_input).
std::string damage_of_packed(const std::string& path);

/// Makes way for a run that cannot be used, as its file is damaged, or the manifest of its folder is or does
/// not name what is there: file or folder becomes `path`.damaged, with a number from the second one on.
/// Returns what was damaged and where it lies now; nothing where all is whole. Throws Error(cannot_create)
/// where another process is at it, or where it cannot be renamed.
std::string set_damaged_aside(const std::string& path);

/// Makes way for another run of that name: a folder becomes `path`.withdrawn, with a number from the second
/// one on. Throws as set_damaged_aside does.
void set_withdrawn_aside(const std::string& path);

/// The folder in which the run `path` is computed.
std::string run_folder(const std::string& path);

}  // namespace talus::io
