#pragma once
/// The analysis of a run in its packed file, quantity by quantity of a table.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/analysis_schema.h"
#include "io/run_file.h"

namespace talus::io {

/// The analysis stored with a packed run; nothing where it has none, or one of another version. Throws
/// Error(bad_data) where it is not what store_analysis writes.
std::optional<analysis::Analysis> read_analysis(
    const RunFile& run, std::span<const analysis::Quantity> table = analysis::quantities());
/// The same of the packed file at `path`. Throws as RunFile::open does as well.
inline std::optional<analysis::Analysis> read_analysis(
    const std::string& path, std::span<const analysis::Quantity> table = analysis::quantities()) {
  return read_analysis(RunFile::open(path), table);
}

/// The readings stored with it, in the order in which they were written.
std::vector<StoredReading> read_readings(const RunFile& run);

/// A packed file without an analysis, with one, and with readings. Sealed.
std::vector<std::byte> with_analysis(const std::vector<std::byte>& packed, const analysis::Analysis& analysis,
                                     const std::vector<StoredReading>& readings,
                                     std::span<const analysis::Quantity> table = analysis::quantities());

/// Replaces the packed file at `path` by one that holds `analysis` as well, in the place of any that it held;
/// all else in it stays as it is. The new file is written whole beside it and then renamed, so that a kill at
/// any instant leaves the one or the other. Throws Error(cannot_create) where the file is not that of the run
/// with `state_hash` any more, Error(io_error) where writing fails. Its frames go, unless they are kept.
void store_analysis(const std::string& path, const analysis::Analysis& analysis,
                    const std::string& state_hash,
                    std::span<const analysis::Quantity> table = analysis::quantities(),
                    bool keep_frames = true);

/// Replaces the readings of the packed file at `path`, which has an analysis. Throws as store_analysis does.
void store_readings(const std::string& path, const std::vector<StoredReading>& readings,
                    const std::string& state_hash);

}  // namespace talus::io
