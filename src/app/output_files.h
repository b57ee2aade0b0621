#pragma once
/// Rules for the output files of commands.

#include <string>

#include "base/output_file.h"
#include "scenario/scenario.h"

namespace talus::app {

/// Returns the rule for output made from a run: it replaces neither the run file nor anything in the folder
/// of the run.
OutputRule output_of_run(const std::string& run, bool overwrite);

/// Returns the rule for the run of a scenario: an existing run may be replaced, but neither the scenario nor
/// the bed that it reads.
OutputRule output_of_scenario(const std::string& file, const scenario::Scenario& scenario);

/// Prints once that a file is written without a lock, if the file system has no locks.
void note_missing_locks();

}  // namespace talus::app
