#pragma once
/// Which runs of an ensemble stay on the disk once their members are done. The tables of a member stay in any
/// case: they are what status, averages and figures of values are made from.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ensemble/ensemble_manifest.h"
#include "ensemble/member_state.h"

namespace talus {

/// Throws Error(usage), naming --keep, unless the text is "all", "analysis" or a number.
void check_keep(const std::string& keep);

/// Whether the run of a seed stays: with "all" or nothing each does, with "analysis" none, and with a number
/// those of so many seeds, the lowest ones of the ensemble.
bool keeps_run(const EnsembleManifest& manifest, std::uint64_t seed);

/// Whether a member lies in the folder of its ensemble, not behind a link to another place, where nothing is
/// to be removed.
bool is_in_folder(const Member& member, const std::string& folder);

/// Removes the run of a member that is done, with a folder that a kill has left of it.
void drop_run(const Member& member);

/// Throws Error(missing_input): the run of a member that is done is gone, and its series as well.
[[noreturn]] void refuse_missing_series(const Member& member);

/// Removes the runs of all members that are done and do not keep theirs: what is left where a worker was
/// killed after it had written the tables of a member, and what was done before the ensemble was told to keep
/// less. A run whose tables are not both there stays, and so does one behind a link. Returns how many were
/// removed.
std::size_t drop_runs(const EnsembleManifest& manifest, const EnsemblePlan& plan, const std::string& folder);

/// Removes the claims of members that are done or have failed: their worker was killed just before it would
/// have done so. Those that a process of this machine holds stay. A worker of another machine may be about to
/// remove its own, and nothing else.
void drop_claims(const EnsemblePlan& plan);

}  // namespace talus
