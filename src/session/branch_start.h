#pragma once
/// Checks that the first state of a branch agrees with its scenario.

#include <string>

#include "io/run_store.h"
#include "scenario/scenario.h"

namespace talus::session {

/// Throws Error(bad_data) if a run of this scenario cannot have the stored start of a branch as its state:
/// walls and floor, phase and step counts, tilt, and settings of commands. `file` denotes the file in
/// messages. Readers of the header have already checked that the grains are those of the run.
void check_branch_start(const io::BranchOrigin& branch, const scenario::Scenario& scenario,
                        const std::string& file);

}  // namespace talus::session
