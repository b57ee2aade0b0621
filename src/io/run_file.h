#pragma once
/// Io stores runs and reads them again, whatever happens in between. A RunStore (run_store.h) writes a
/// folder, commit by commit, and packs it when the run is done; a RunFile reads either; run_schema.h lists
/// every data set. Below them are the files themselves: hdf5_file.h, durable_file.h, child_process.h.
///
/// Reads a run, packed or in its folder, frame by frame in bounded memory. Every byte is compared with its
/// hash before it is interpreted.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/run_store.h"

namespace talus::io {

namespace hdf5 {
class Reader;
}

class RunFile {
 public:
  /// Opens `path`: a packed file, a folder `path.run/`, or such a folder by its own name; its writer may be
  /// at work. Throws Error(missing_input) if the run does not exist, and Error(bad_data) with the name of the
  /// damaged file or data set. The library tries each run in a child process first (child_process.h).
  static RunFile open(const std::string& path);

  /// Opens a packed file in memory that this process has made. Throws Error(bad_data), naming `name`.
  static RunFile from_bytes(std::vector<std::byte> bytes, const std::string& name);

  RunFile(RunFile&&) noexcept;
  RunFile& operator=(RunFile&&) noexcept;
  ~RunFile();

  const RunHeader& header() const;
  bool complete() const;  ///< false for the folder of an interrupted or running run
  /// Whether the scenario has a programme (tilt.program).
  bool has_program() const;
  /// Whether the tilt does not only grow from frame to frame, because of a programme or of commands: then it
  /// may be held, decrease and change sign, and only their times distinguish frames.
  bool goes_by_time() const;
  /// Return the frames or rows of the tilt, whatever its course: those up to its last step. Only if the slope
  /// has failed and the run follows the flow after failure (tilt.after_failure) are there others, of that
  /// flow; only functions with the prefix all_ include these. The first frame always belongs to the tilt.
  std::size_t frame_count() const { return frame_tilts().size(); }
  const std::vector<double>& frame_tilts() const;  ///< rad; ascending unless goes_by_time
  std::vector<ObservableRow> observables() const;

  const std::vector<double>& all_frame_tilts() const;  ///< rad
  const std::vector<double>& all_frame_times() const;  ///< s
  std::vector<ObservableRow> all_observables() const;
  std::uint64_t contact_count() const;  ///< total of all frames
  /// Whether frames are stored. A file that was kept for its analysis alone (talus ensemble --keep analysis)
  /// has only their steps, times and tilts.
  bool has_frames() const;
  /// Returns step, time and tilt of frame k, which are always stored.
  Frame instant(std::size_t k) const;
  /// Returns frame k, k < all_frame_tilts().size(). Values are those of the file (single precision if it
  /// stores floats); contacts that carry no force, which earlier versions stored, are left out
  /// (remove_open_contacts). Not safe for several threads at once. Throws Error(missing_input) if the file
  /// has no frames.
  Frame frame(std::size_t k) const;
  /// Returns frame k with everything stored; otherwise as frame.
  Frame stored_frame(std::size_t k) const;
  /// Whether a frame that was read by stored_frame(k) matches its stored hash.
  bool is_as_written(const Frame& frame, std::size_t k) const;
  /// Returns the paths of the data sets that do not match their own hashes, in a packed file with its
  /// analysis, or in the segments of a folder.
  std::vector<std::string> changed_data_sets() const;
  /// Returns only step, time, tilt, x, y and image of frame k, several times faster than frame.
  Frame positions(std::size_t k) const;
  /// Returns the quantities of scripts, without their values, which are in Frame::own.
  const std::vector<OwnQuantity>& own() const;
  std::vector<StepRow> steps() const;
  /// Returns the commands given to the run while it was computed, in order.
  const std::vector<Command>& commands() const;
  /// Returns the friction between grains that a command, of the run or before the start of a branch, had set
  /// in the step that ended as number `step`; empty if none had.
  std::optional<double> commanded_friction(std::int64_t step) const;
  /// Returns the friction in force in the step that led to frame k, and thus to its forces: that of a
  /// command, otherwise of the scenario, of its deposition in the frame of the bed at rest.
  Friction friction_of_frame(std::size_t k) const;
  /// Returns the outcomes of perturbed copies of the bed on the way to failure, in order.
  std::vector<TrialRow> trials() const;
  const Checkpoint& checkpoint() const;  ///< last state, with results and timing
  /// Whether the last state is stored. A repaired run may have lost it; its checkpoint then has no grains.
  bool has_state() const { return checkpoint().world.grains.count() > 0; }
  /// Returns what the run lost before it was repaired; empty if nothing is missing.
  std::string lost() const;
  /// Returns a reader of the open packed file in which no letter has a value yet. Private to src/io.
  hdf5::Reader packed_reader() const;

 private:
  struct State;
  explicit RunFile(std::unique_ptr<State> state);
  static RunFile read_packed(hdf5::Reader&& reader, const std::string& name);
  static RunFile open_folder(const std::string& folder);
  std::unique_ptr<State> state_;
};

/// Whether `path` is a run or has the name of one: a packed file, an HDF5 file, a folder, or something.h5.
bool is_run(const std::string& path);

/// Returns a frame as it will be read back, in single precision if the file stores floats.
Frame as_stored(Frame frame);

// Repairs a run that was damaged at rest: copies every frame whose hash matches, and every other undamaged
// part, into a new run.

struct RepairRequest {
  std::string run;     ///< a packed file, or the folder of a run, by its own name or that of its file
  std::string output;  ///< path of the new run, a packed file
  bool overwrite = false;
};

struct RepairReport {
  bool was_whole = false;               ///< whether the run was undamaged; nothing was written then
  bool of_folder = false;               ///< whether the run was a folder, that is, incomplete
  std::vector<std::string> kept, lost;  ///< one line each
};

/// Repairs a run. Throws Error(missing_input) if the run does not exist, Error(bad_data) if nothing can be
/// kept of it, and Error(cannot_create) if the output already exists or a process is writing the run.
RepairReport repair_run(const RepairRequest& request);

/// Returns the damaged pieces of a run, one line each. Throws Error(missing_input).
std::vector<std::string> damaged_pieces(const std::string& run);

}  // namespace talus::io
