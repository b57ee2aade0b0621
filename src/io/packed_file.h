#pragma once
/// The packed file of a finished run: its contents, its bytes (private to src/io), and what is stored in it
/// later.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/run_file.h"
#include "io/run_schema.h"

namespace talus::io {

/// The contents of a packed file; frames are requested one after another.
struct RunContent {
  RunHeader header;
  Checkpoint checkpoint;
  Segment series;  ///< without frames
  std::size_t frames = 0;
  std::uint64_t contacts = 0;  ///< total of all frames
  std::function<Frame(std::size_t)> frame_at;
  bool has_frames = true;  ///< false: only steps, times and tilts of frames are stored
};
/// Returns the contents of a run, which must outlive them; without frames if not wanted.
RunContent content_of(const RunFile& run, bool with_frames = true);

/// Whether a run was repaired without its last state, and so has no /checkpoint.
bool lacks_state(const RunHeader& header, const Checkpoint& checkpoint);

/// Returns the bytes of the packed file, sealed. Equal runs give equal bytes, however they were committed. If
/// `should_continue` is given, it is called before each frame; if it returns false, this returns nothing.
std::vector<std::byte> packed_bytes(const RunContent& run, const std::function<bool()>& should_continue = {});

// The analysis of a run in its packed file, stored by quantity.

/// Returns the analysis stored with a packed run, or nothing if there is none or it has another version.
/// Throws Error(bad_data) if store_analysis cannot have written it.
std::optional<analysis::Analysis> read_analysis(
    const RunFile& run, std::span<const analysis::Quantity> table = analysis::quantities());
/// Returns the analysis stored in the packed file at `path`. Throws also the errors of RunFile::open.
inline std::optional<analysis::Analysis> read_analysis(
    const std::string& path, std::span<const analysis::Quantity> table = analysis::quantities()) {
  return read_analysis(RunFile::open(path), table);
}

/// Returns the stored readings, in the order in which they were written.
std::vector<StoredReading> read_readings(const RunFile& run);

/// Returns the quantities that scripts have stored, with the values of all frames one after another.
std::vector<OwnQuantity> read_own(const RunFile& run);

/// Returns the packed file with these quantities added, as with_analysis does. `sizes` are T, N and M.
std::vector<std::byte> with_own(const std::vector<std::byte>& packed, const std::string& name, Sizes sizes,
                                const std::vector<OwnQuantity>& own);

/// Returns the bytes of a packed file, called `name` in messages, with an analysis and readings added,
/// sealed.
std::vector<std::byte> with_analysis(const std::vector<std::byte>& packed, const std::string& name,
                                     const analysis::Analysis& analysis,
                                     const std::vector<StoredReading>& readings,
                                     std::span<const analysis::Quantity> table = analysis::quantities());

/// Replaces the packed file at `path` by one that contains `analysis`, which replaces any stored analysis;
/// everything else is unchanged, except that the frames are removed unless `keep_frames`. The new file is
/// written completely next to the old one and then renamed, so that a kill at any instant leaves one of the
/// two. Throws Error(cannot_create) if the file no longer belongs to the run with `state_hash`, and
/// Error(io_error) if writing fails.
void store_analysis(const std::string& path, const analysis::Analysis& analysis,
                    const std::string& state_hash,
                    std::span<const analysis::Quantity> table = analysis::quantities(),
                    bool keep_frames = true);

/// Replaces the readings of the packed file at `path`, which has an analysis. Throws the errors of
/// store_analysis.
void store_readings(const std::string& path, const std::vector<StoredReading>& readings,
                    const std::string& state_hash);

/// Stores the values of all frames, in place of those of the same name. Throws the errors of store_analysis.
void store_own(const std::string& path, const OwnQuantity& own, const std::string& state_hash);

}  // namespace talus::io
