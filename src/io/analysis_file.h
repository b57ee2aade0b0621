#pragma once
/// The analysis of a run in its packed file, quantity by quantity of a table.

#include <optional>
#include <string>

#include "io/analysis_schema.h"

namespace talus {

/// The analysis stored in the packed file at `path`; nothing where it has none, or one of another version.
/// Throws Error(missing_input) or Error(bad_data) as RunFile::open does.
std::optional<Analysis> read_analysis(const std::string& path,
                                      std::span<const Quantity> table = quantities());

/// Replaces the packed file at `path` by one that holds `analysis` as well, in the place of any that it held;
/// all else in it stays as it is. The new file is written whole beside it and then renamed, so that a kill at
/// any instant leaves the one or the other. Throws Error(cannot_create) where the file is not that of the run
/// with `state_hash` any more, Error(io_error) where writing fails.
void store_analysis(const std::string& path, const Analysis& analysis, const std::string& state_hash,
                    std::span<const Quantity> table = quantities());

}  // namespace talus
