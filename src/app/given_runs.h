#pragma once
/// The runs among paths that a wildcard gives.

#include <string>
#include <vector>

#include "ensemble/plan.h"

namespace talus::app {

/// The members of an ensemble's folder that are done. Throws Error(missing_input) where none is.
std::vector<ensemble::Member> done_members(const std::string& folder);

/// Paths with the runs of its done members in place of the folder of an ensemble.
std::vector<std::string> with_members(const std::vector<std::string>& paths);

/// Several paths without the files that are neither runs nor what `is_wanted_too` takes, such as the contact
/// problem that `talus dump` has left beside them; each is named on standard error. Folders, and paths where
/// nothing is, stay, and so does a path that is given alone: for these the command itself says what is wrong.
/// Throws Error(bad_data) where nothing is left.
std::vector<std::string> runs_among(const std::vector<std::string>& paths,
                                    bool (*is_wanted_too)(const std::string&) = nullptr);

}  // namespace talus::app
