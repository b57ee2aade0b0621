#pragma once
/// Whether the state that a branch begins from is one of its scenario.

#include <string>

#include "io/run_store.h"
#include "scenario/scenario.h"

namespace talus::session {

/// Throws Error(bad_data) where the stored start of a branch is not a state that a run of this scenario can
/// have: its walls and floor, its phase and numbers of steps, its tilt, and what commands had set. `file` is
/// what messages call the file. That its grains are those of the run is known of any header that was read.
void check_branch_start(const io::BranchOrigin& branch, const scenario::Scenario& scenario,
                        const std::string& file);

}  // namespace talus::session
