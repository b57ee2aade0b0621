#pragma once
/// The packed file of a finished run: its seal, its H5MD metadata, its bytes. Private to this room.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "io/run_file.h"

namespace talus {

/// Bytes before the HDF5 part (its "user block"): a text with the size and the hash of the file. With it
/// damage anywhere is found before HDF5 sees the file, which malformed data can crash.
inline constexpr std::size_t seal_size = 512;

/// Fills the first seal_size bytes with the seal of the rest.
void seal(std::vector<std::byte>& file);

/// The size that the seal of a file gives it; 0 where it has none.
std::uint64_t sealed_size(std::span<const std::byte> file);

/// The hash of the seal of a packed file, which holds that of all that follows: other files, other hashes.
std::uint64_t seal_hash(std::span<const std::byte> file);
/// The same of the file at `path`, of which no more than the seal is read. Throws Error(missing_input).
std::uint64_t seal_hash_of(const std::string& path);

/// Reads the whole file at `path` once. Throws Error(missing_input) where it cannot be read and
/// Error(bad_data) where its seal is missing or wrong.
void verify_seal(const std::string& path);

/// All that a packed file holds of a run; frames are asked for one after another.
struct RunContent {
  RunHeader header;
  Checkpoint checkpoint;
  std::vector<ObservableRow> observables;
  std::vector<StepRow> steps;
  std::vector<Command> commands;
  std::vector<TrialRow> trials;
  std::size_t frames = 0;
  std::uint64_t contacts = 0;  ///< of all frames
  std::function<Frame(std::size_t)> frame_at;
  bool has_frames = true;  ///< false: of frames only steps, times and tilts are stored
};
/// Of a run, which must outlive it; without its frames where it has none, or they are not wanted.
RunContent content_of(const RunFile& run, bool with_frames = true);

/// Whether a run was repaired and lacks its last state: it has no /checkpoint.
bool lacks_state(const RunHeader& header, const Checkpoint& checkpoint);

/// The packed file, sealed. Equal runs give equal bytes, however they were committed. Asks before each frame
/// whether it `goes_on`, if asked to; returns nothing where it does not.
std::vector<std::byte> packed_bytes(const RunContent& run, const std::function<bool()>& goes_on = {});

}  // namespace talus
