#pragma once
/// Selects the runs among the paths that a wildcard yields.

#include <string>
#include <vector>

namespace talus::app {

/// Replaces each folder of an ensemble by the runs of its finished members. Throws Error(missing_input) if
/// none is done.
std::vector<std::string> with_members(const std::vector<std::string>& paths);

/// Removes files that are no runs, such as a contact problem written by `talus dump`; each is reported on
/// standard error. Folders, missing paths and a single path are kept: for these the command itself reports
/// the error. Throws Error(bad_data) if no path is left.
std::vector<std::string> runs_among(const std::vector<std::string>& paths);

}  // namespace talus::app
