#pragma once
/// The data sets of a problem file in one table: those of FCLIB, and those added by Talus. Files are written
/// and checked by this table, and a test compares docs/problem_files.md with it.

#include <string>
#include <vector>

#include "io/run_schema.h"

namespace talus::problems {

/// Returns the table. The letters of the shapes are B bodies, C contacts, U = 2 C unknowns, E entries of W.
const std::vector<io::DataSetField>& fclib_schema();

/// Returns the row of a data set. Throws Error(internal) if the table does not contain it.
const io::DataSetField& fclib_field(const std::string& path);

}  // namespace talus::problems
