#pragma once
/// Selects the completed members whose frames are kept. Run and analysis of a member are always kept, because
/// status, averages and figures need them.

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

/// Whether the frames of a seed are kept: always with "all" or an empty text, never with "analysis", and with
/// a number N for the N lowest seeds of the ensemble.
bool keeps_frames(const EnsembleManifest& manifest, std::uint64_t seed);

/// Whether a member is in the folder of its ensemble. Nothing is removed from members behind a link to
/// another place.
bool is_in_folder(const Member& member, const std::string& folder);

/// Removes the frames of all completed members that need not keep them, because `keep` was reduced after they
/// were completed. A run behind a link keeps its frames. Returns the number of changed runs.
std::size_t drop_frames(const EnsembleManifest& manifest, const EnsemblePlan& plan, const std::string& folder,
                        KnownMembers& known);

/// Removes leftovers of workers that were killed just before they would have removed them: claims of members
/// that are done or have failed, except those held by a process of this machine, and folders of packed runs.
/// A worker of another machine can at most be about to remove its own. Throws the errors of discard_folder.
void drop_leftovers(const EnsemblePlan& plan);

}  // namespace talus::ensemble
