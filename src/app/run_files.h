#pragma once
/// Files that commands name: the runs among the paths that a wildcard yields, and outputs.

#include <string>
#include <vector>

#include "base/output_file.h"
#include "scenario/scenario.h"

namespace talus::app {

/// Replaces ensembles by the runs of their finished members. Throws Error(missing_input) if none is done.
std::vector<std::string> with_members(const std::vector<std::string>& paths);

/// Removes files that are no runs, such as a contact problem written by `talus dump`; each is reported on
/// standard error. Folders, missing paths and a single path are kept: for these the command itself reports
/// the error. Throws Error(bad_data) if no path is left.
std::vector<std::string> runs_among(const std::vector<std::string>& paths);

/// Returns the rule for output made from a run: it replaces neither its file nor anything in its folder.
OutputRule output_of_run(const std::string& run, bool overwrite);

/// Returns the rule for the run of a scenario: a run may be replaced, but neither the scenario nor its bed.
OutputRule output_of_scenario(const std::string& file, const scenario::Scenario& scenario);

/// Prints once that a file is written without a lock, if the file system has no locks.
void note_missing_locks();

}  // namespace talus::app
