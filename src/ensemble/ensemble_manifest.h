#pragma once
/// The definition of an ensemble: a small text file in its folder, for any number of processes and machines.

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

/// Returns the text of a manifest: JSON, whose last member is the hash of the text before it.
std::string manifest_text(const EnsembleManifest& manifest);
/// Parses the text of the manifest at `path`, without the scenarios. Throws Error(bad_data), with the place,
/// unless it is exactly the text of a manifest.
EnsembleManifest parse_manifest(const std::string& text, const std::string& path);

/// Reads the manifest and the scenarios. Throws Error(missing_input) if there is no ensemble, and
/// Error(bad_data) if talus does not write such a manifest, or if a scenario differs from the original one.
EnsembleManifest read_ensemble(const std::string& folder);

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
