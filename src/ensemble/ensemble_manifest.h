#pragma once
/// What an ensemble is: a small text file in its folder, from which any number of processes of any number of
/// machines work.

#include <cstdint>
#include <string>
#include <vector>

#include "ensemble/member_task.h"
#include "ensemble/plan.h"

namespace talus::ensemble {

struct EnsembleManifest {
  std::string version = {};               ///< of the Talus that wrote it
  std::vector<std::uint64_t> seeds = {};  ///< ascending
  std::string until = {};                 ///< "theta_c:0.2": no more members from then on; empty: all of them
  std::vector<Variant> variants = {};     ///< their scenario files lie in the folder
  MemberTask task = {};
  std::string keep = {};  ///< which runs stay once they are done (keeps_run); empty: all
};

/// DIR/ensemble.manifest.
std::string manifest_path(const std::string& folder);

/// Whether there is an ensemble in the folder.
bool is_ensemble(const std::string& folder);

/// The members, in files of the folder.
EnsemblePlan plan_of(const EnsembleManifest& manifest, const std::string& folder);

/// Reads manifest and scenarios. Throws Error(missing_input) where there is no ensemble, Error(bad_data)
/// where the manifest is damaged, says what talus never writes (with its line), or where a scenario is not
/// what the ensemble began with.
EnsembleManifest read_ensemble(const std::string& folder);

/// Variants of a scenario: each combination of a value of each axis ("contact.friction=0.3,0.5"), named by
/// them (folder_name); without axes the scenario itself, without a name. Their seeds are 1 and count for
/// nothing; the file of a bed is an absolute path, since members are computed from other places. Throws as
/// read_scenario and parse_axis do, and Error(usage) for too many of them, and for a path that no scenario
/// file can hold.
std::vector<Variant> plan_variants(const std::string& scenario_file, const std::vector<std::string>& settings,
                                   const std::vector<std::string>& axes);

/// Gives variants whose scenario an ensemble has already the names that they have there: earlier versions
/// called them otherwise.
void take_earlier_names(std::vector<Variant>& variants, const std::string& folder);

/// Reads the beds of variants that take them from a file (deposition.file), and notes their hashes. Throws as
/// bed_of_file does, unless the ensemble in the folder has the variant already, whose members report it; and
/// Error(bad_data) where the file has held another bed when the ensemble began.
void hash_beds(std::vector<Variant>& variants, const std::string& folder);

/// Begins an ensemble in the folder, or adds to the one that is there what it lacks: seeds and variants.
/// `until` and `keep` replace those before, unless they are empty. A variant that is not wanted is withdrawn
/// where all that is known of it is that it fails: a member has failed, or its bed cannot be made, and no
/// member has a run, is done or under way. The manifest is written last, whole or not at all. Returns what is
/// there then. Throws Error(bad_data) where a variant of the same name has another
/// scenario there, where none of the variants is there yet, or where the members have another task; otherwise
/// as write_text does.
EnsembleManifest extend_ensemble(const std::string& folder, const EnsembleManifest& wanted);

}  // namespace talus::ensemble
