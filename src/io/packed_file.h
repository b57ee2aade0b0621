#pragma once
/// The packed file of a finished run: its contents, its H5MD metadata, and its bytes. Private to src/io.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "io/run_file.h"

namespace talus::io {

/// The contents of a packed file; frames are requested one after another.
struct RunContent {
  RunHeader header;
  Checkpoint checkpoint;
  std::vector<ObservableRow> observables;
  std::vector<StepRow> steps;
  std::vector<Command> commands;
  std::vector<TrialRow> trials;
  std::size_t frames = 0;
  std::uint64_t contacts = 0;  ///< total of all frames
  std::function<Frame(std::size_t)> frame_at;
  bool has_frames = true;  ///< false: only steps, times and tilts of frames are stored
};
/// Returns the contents of a run, which must outlive them; without frames if it has none or they are not
/// wanted.
RunContent content_of(const RunFile& run, bool with_frames = true);

/// Whether a run was repaired without its last state, and so has no /checkpoint.
bool lacks_state(const RunHeader& header, const Checkpoint& checkpoint);

/// Returns the bytes of the packed file, sealed. Equal runs give equal bytes, however they were committed. If
/// `should_continue` is given, it is called before each frame; if it returns false, this returns nothing.
std::vector<std::byte> packed_bytes(const RunContent& run, const std::function<bool()>& should_continue = {});

}  // namespace talus::io
