#pragma once
/// Selects the runs among the paths that a wildcard yields.

#include <string>
#include <vector>

#include "ensemble/plan.h"

namespace talus::app {

/// Returns the finished members of an ensemble's folder. Throws Error(missing_input) if none is done.
std::vector<ensemble::Member> done_members(const std::string& folder);

/// Replaces each folder of an ensemble by the runs of its finished members.
std::vector<std::string> with_members(const std::vector<std::string>& paths);

/// Removes files that are neither runs nor accepted by `is_wanted_too`, such as a contact problem written by
/// `talus dump`; each is reported on standard error. Folders, missing paths and a single path are kept: for
/// these the command itself reports the error. Throws Error(bad_data) if no path is left.
std::vector<std::string> runs_among(const std::vector<std::string>& paths,
                                    bool (*is_wanted_too)(const std::string&) = nullptr);

}  // namespace talus::app
