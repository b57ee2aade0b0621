#pragma once
/// The definition of an ensemble: a small text file in its folder, used by any number of processes on any
/// number of machines.

#include <cstdint>
#include <string>
#include <vector>

#include "ensemble/member_task.h"
#include "ensemble/plan.h"

namespace talus::ensemble {

struct EnsembleManifest {
  std::string version = {};               ///< version of Talus that wrote it
  std::vector<std::uint64_t> seeds = {};  ///< ascending
  std::string until = {};                 ///< "theta_c:0.2": no new members once reached; empty: all members
  std::vector<Variant> variants = {};     ///< their scenario files are in the folder
  MemberTask task = {};
  std::string keep = {};  ///< selects the members whose frames are kept (keeps_frames); empty: all
};

/// Returns DIR/ensemble.manifest.
std::string manifest_path(const std::string& folder);

/// Whether the folder contains an ensemble.
bool is_ensemble(const std::string& folder);

/// Returns the plan of the members, with their files in the folder.
EnsemblePlan plan_of(const EnsembleManifest& manifest, const std::string& folder);

/// Reads the manifest and the scenarios. Throws Error(missing_input) if there is no ensemble, and
/// Error(bad_data) if the manifest is damaged or has a line that talus never writes (with its number), or if
/// a scenario differs from the original one.
EnsembleManifest read_ensemble(const std::string& folder);

/// Returns the variants of a scenario: one for each combination of values of the axes
/// ("contact.friction=0.3,0.5"), named by folder_name. Without axes it returns the scenario itself, without a
/// name. Their seed is 1 and has no effect. The file of a bed becomes an absolute path, because members are
/// computed in other working directories. Throws the errors of read_scenario and parse_axis, and Error(usage)
/// for too many variants and for a path that no scenario file can hold.
std::vector<Variant> plan_variants(const std::string& scenario_file, const std::vector<std::string>& settings,
                                   const std::vector<std::string>& axes);

/// Returns the variants of a study: the scenario itself, called "baseline", and each value of each axis alone
/// ("tilt.step=0.002", "tilt.rate=2,tilt.step=0.002"), without those that equal an earlier one. An axis
/// overrides `settings`. Throws as plan_variants does.
std::vector<Variant> plan_one_at_a_time(const std::string& scenario_file,
                                        const std::vector<std::string>& settings,
                                        const std::vector<std::string>& axes);

/// Replaces the names of variants that an ensemble already contains by their stored names, because earlier
/// versions named variants differently.
void take_earlier_names(std::vector<Variant>& variants, const std::string& folder);

/// Reads the beds of variants with deposition.file, and stores their hashes. Throws the errors of bed_of_file
/// unless the ensemble in the folder already has the variant, whose members then report them. Throws
/// Error(bad_data) if the file held a different bed when the ensemble began.
void hash_beds(std::vector<Variant>& variants, const std::string& folder);

/// Begins an ensemble in the folder, or adds missing seeds and variants to an existing one. `until` and
/// `keep` replace the stored values unless they are empty. An unwanted variant is withdrawn if it has only
/// failures: a member has failed or its bed cannot be made, and no member has a run, is done or is under way.
/// The manifest is written last and atomically. Returns the resulting manifest. Throws Error(bad_data) if a
/// variant of the same name has another scenario, if none of the variants exists yet, or if the members have
/// another task; otherwise the errors of write_text.
EnsembleManifest extend_ensemble(const std::string& folder, const EnsembleManifest& wanted);

}  // namespace talus::ensemble
