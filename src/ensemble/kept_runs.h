#pragma once
/// Which members of an ensemble keep the frames of their runs once they are done. Run and analysis of a
/// member stay in any case: they are what status, averages and figures of values are made from.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ensemble/ensemble_manifest.h"
#include "ensemble/member_reader.h"
#include "ensemble/member_state.h"

namespace talus::ensemble {

/// Throws Error(usage), naming --keep, unless the text is "all", "analysis" or a number.
void check_keep(const std::string& keep);

/// Whether the frames of a seed stay: with "all" or nothing those of each do, with "analysis" of none, and
/// with a number those of so many seeds, the lowest ones of the ensemble.
bool keeps_frames(const EnsembleManifest& manifest, std::uint64_t seed);

/// Whether a member lies in the folder of its ensemble, not behind a link to another place, where nothing is
/// to be removed.
bool is_in_folder(const Member& member, const std::string& folder);

/// Removes the frames of all members that are done and do not keep theirs: of those that were done before the
/// ensemble was told to keep less. A run behind a link keeps them. Returns how many were changed.
std::size_t drop_frames(const EnsembleManifest& manifest, const EnsemblePlan& plan, const std::string& folder,
                        KnownMembers& known);

/// Removes what workers have left that were killed just before they would have removed it: the claims of
/// members that are done or have failed, but for those that a process of this machine holds, and the folders
/// of runs that are packed. A worker of another machine may be about to remove its own, and nothing else.
/// Throws as discard_folder does.
void drop_leftovers(const EnsemblePlan& plan);

}  // namespace talus::ensemble
