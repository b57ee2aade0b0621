#pragma once
/// The packed file of a finished run: what it holds, its H5MD metadata, its bytes. Private to this room.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "io/run_file.h"

namespace talus::io {

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

}  // namespace talus::io
