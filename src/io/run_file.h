#pragma once
/// Reading a run, packed or still a folder, frame by frame in bounded memory. Every byte is compared with its
/// hash before it is interpreted.

#include <cstdint>
#include <memory>
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
  /// at work. Throws Error(missing_input) where there is no such run, and Error(bad_data) with the name of
  /// the file or data set that is damaged.
  static RunFile open(const std::string& path);

  /// A packed file in memory, which this process has made. Throws Error(bad_data), naming `name`.
  static RunFile of_bytes(std::vector<std::byte> bytes, const std::string& name);

  RunFile(RunFile&&) noexcept;
  RunFile& operator=(RunFile&&) noexcept;
  ~RunFile();

  const RunHeader& header() const;
  bool complete() const;  ///< false for the folder of an interrupted or running run
  /// Whether the tilt followed a programme (tilt.program): then it may fall and be held, and change its sign.
  bool has_program() const;
  /// Of the tilt: up to the first frame, or row of observables, with the highest tilt; with a programme up to
  /// its last step. Those of a flow that was followed after failure (tilt.after_failure) come after them;
  /// only all_... tell of these too.
  std::size_t frame_count() const { return frame_tilts().size(); }
  const std::vector<double>& frame_tilts() const;  ///< rad; ascending without a programme
  std::vector<ObservableRow> observables() const;

  const std::vector<double>& all_frame_tilts() const;  ///< rad
  const std::vector<double>& all_frame_times() const;  ///< s
  std::vector<ObservableRow> all_observables() const;
  std::uint64_t contact_count() const;  ///< of all frames together
  /// False for a file that was kept for its analysis alone (talus ensemble --keep analysis): of its frames
  /// only steps, times and tilts are known.
  bool has_frames() const;
  /// Of frame k only step, time and tilt, which are always there.
  Frame instant(std::size_t k) const;
  /// Frame k with everything stored, k < all_frame_tilts().size(). Values are those of the file (single
  /// precision where it stores floats). Not for several threads at once. Throws Error(missing_input) where
  /// the file has no frames.
  Frame frame(std::size_t k) const;
  /// Whether a frame that was read as frame k is the one whose hash was stored with it.
  bool is_as_written(const Frame& frame, std::size_t k) const;
  /// Paths of the data sets that do not agree with their own hashes: of a packed file, its analysis included,
  /// or of the segments of a folder.
  std::vector<std::string> changed_data_sets() const;
  /// Of frame k only step, time, tilt, x and y: read several times faster than all of it. Throws as frame
  /// does.
  Frame positions(std::size_t k) const;
  std::vector<StepRow> steps() const;
  /// What was done to the run while it went on, in order.
  std::vector<Command> commands() const;
  /// What became of copies of the bed that were pushed on its way to failure, in order.
  std::vector<TrialRow> trials() const;
  const Checkpoint& checkpoint() const;  ///< the last state, with results and timing
  /// Whether the last state is there; it may be lost in a run that was repaired, and is without grains then.
  bool has_state() const { return checkpoint().world.grains.count() > 0; }
  /// What was lost of a run before it was repaired; empty for a run of which nothing is missing.
  std::string lost() const;
  /// The packed file that is open, of whose letters nothing is known yet. Private to this room.
  hdf5::Reader packed_reader() const;

 private:
  struct State;
  explicit RunFile(std::unique_ptr<State> state);
  static RunFile open_packed(const std::string& path);
  static RunFile read_packed(hdf5::Reader&& reader, const std::string& name);
  static RunFile open_folder(const std::string& folder);
  std::unique_ptr<State> state_;
};

/// Whether what is at `path` is, or is named as, a run: a packed file, an HDF5 file, a folder, or
/// something.h5.
bool is_run(const std::string& path);

/// A frame as it will be read back: in single precision where the file stores floats.
Frame as_stored(Frame frame);

}  // namespace talus::io
