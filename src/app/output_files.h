#pragma once
/// Files that a command is about to write.

#include <string>

#include "base/output_file.h"
#include "scenario/scenario.h"

namespace talus::app {

/// The rule for what a command makes of a run: it replaces neither the file nor anything in the folder of the
/// run.
OutputRule output_of_run(const std::string& run, bool overwrite);

/// The rule for the run of a scenario, which may be replaced: not the scenario, and not the bed that it
/// reads.
OutputRule output_of_scenario(const std::string& file, const scenario::Scenario& scenario);

/// Prints once that a file is written without a lock, where the file system has none.
void note_missing_locks();

}  // namespace talus::app
