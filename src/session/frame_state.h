#pragma once
/// The state of a run at one of its frames, so that something can begin there.

#include "io/run_file.h"
#include "session/schedule.h"

namespace talus::session {

/// The world at frame k: from the checkpoint, to the last bit, where that is the same step; else from the
/// single precision of the frame, with the contacts that carried force as memory. Throws Error(bad_data)
/// where the run was repaired and has lost its last state.
World world_at_frame(const io::RunFile& run, std::size_t k);

/// Whether a run was repaired and has lost what may have held commands: what was in force at a step is not
/// known then.
bool may_lack_commands(const io::RunFile& run);

/// A schedule of which only that is set which the commands given before a step, and before the run began,
/// have set: friction, rate of the tilt, drag.
Schedule set_by_commands(const io::RunFile& run, std::int64_t step);

/// All that a run needs to go on from frame k. What the series of the run tell is that of the run: the phase
/// and its steps, how long the bed has been at rest, what commands have set, where strains are counted from.
/// What a run counts begins at nought: wall times, warnings, steps that did not converge. Throws as
/// world_at_frame, Error(bad_data) where a repaired run lacks steps, rows or commands, and Error(usage) where
/// the run ends with that frame. `branch` is the scenario with which it goes on [that of the run]: one that
/// tells the same of what lies before.
io::Checkpoint checkpoint_at_frame(const io::RunFile& run, std::size_t k,
                                   const scenario::Scenario* branch = nullptr);

/// The checkpoint with which a stored branch begins: a file keeps its state, and no results.
io::Checkpoint start_of(const io::BranchOrigin& branch);

}  // namespace talus::session
