#pragma once
/// Small run with a different value in every field, for the tests of the run store.

#include <string>

#include "io/run_schema.h"
#include "io/run_store.h"
#include "support/process.h"

namespace talus::example {

using test::TemporaryFolder;

inline constexpr Index grain_count = 6;
inline constexpr Index free_grain_count = 4;

io::RunHeader header();
/// Returns commit number k with k % 3 frames at ascending tilts, 2 rows of observables, 5 of steps and k / 2
/// commands.
io::Segment segment(int k);
io::Checkpoint checkpoint(int k);

/// Returns a store with the commits 0 ... count - 1.
io::RunStore store_with_commits(const std::string& path, int count);

/// Returns the row of a data set in the tables of docs/file_format.md and docs/analysis.md.
std::string row_text(const io::DataSetField& field);

void write_text(const std::string& path, const std::string& text);

}  // namespace talus::example
