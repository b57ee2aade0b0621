#pragma once
/// The analysis of a run in its packed file, stored by quantity.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/analysis_schema.h"
#include "io/run_file.h"

namespace talus::io {

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

}  // namespace talus::io
