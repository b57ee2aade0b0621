#pragma once
/// The data sets of a problem file, in one table: those of FCLIB and those of Talus beside them. Files are
/// written and checked from it, and docs/problem_files.md is compared with it by a test.

#include <string>
#include <vector>

#include "io/run_schema.h"

namespace talus::problems {

/// Letters of the shapes: B bodies, C contacts, U = 2 C unknowns, E entries of W.
const std::vector<io::DataSetField>& fclib_schema();

/// The row of a data set. Throws Error(internal) where the table has none.
const io::DataSetField& fclib_field(const std::string& path);

}  // namespace talus::problems
