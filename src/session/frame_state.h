#pragma once
/// State of a run at one of its frames, from which a computation can start.

#include <string>

#include "io/run_file.h"
#include "io/run_store.h"
#include "scenario/scenario.h"
#include "session/schedule.h"

namespace talus::session {

using scenario::Scenario;

// Checks that the first state of a branch agrees with its scenario.

/// Throws Error(bad_data) if a run of this scenario cannot have the stored start of a branch as its state:
/// walls and floor, phase and step counts, tilt, and settings of commands. `file` denotes the file in
/// messages. Readers of the header have already checked that the grains are those of the run.
void check_branch_start(const io::BranchOrigin& branch, const Scenario& scenario, const std::string& file);

/// Returns the world at frame k: bit-identical from the checkpoint if it is of the same step; otherwise from
/// the single precision of the frame, with the contacts that carried force as memory. Throws Error(bad_data)
/// if the run was repaired and has lost its last state.
World world_at_frame(const io::RunFile& run, std::size_t k);

/// Whether a run was repaired and may have lost commands, so that the settings in force at a step are
/// unknown.
bool may_lack_commands(const io::RunFile& run);

/// Returns the number of steps before the first one of the tilt, also of the run that a branch left.
std::int64_t steps_before_tilt(const io::RunFile& run);

/// Returns a schedule with only the settings of commands given before a step, including those before the run
/// started: friction, rate of the tilt, drag.
Schedule commanded_schedule(const io::RunFile& run, std::int64_t step);

/// Returns everything that a run needs to continue from frame k. State that the series record is that of the
/// run: the phase and its steps, the time at rest, settings of commands, the baseline of strains. Counters
/// start at zero: wall times, warnings, unconverged steps. Throws as world_at_frame does, Error(bad_data) if
/// a repaired run lacks steps, rows or commands, and Error(usage) if the run ends with that frame. `branch`
/// is the scenario with which the run continues, by default its own; it must agree on everything before the
/// frame.
io::Checkpoint checkpoint_at_frame(const io::RunFile& run, std::size_t k, const Scenario* branch = nullptr);

/// Returns the checkpoint of a branch from its start in a file, which has no results.
io::Checkpoint start_of(io::Checkpoint start);

}  // namespace talus::session
