#pragma once
/// The plan of an ensemble: variants of a scenario, each with the same seeds.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "scenario/scenario.h"

namespace talus::ensemble {

/// Hashes of the inputs of the members of a variant; empty if unknown.
struct MemberOrigin {
  std::string scenario = {};  ///< hash of the variant's scenario file in the folder of the ensemble
  std::string bed = {};       ///< hash of the bed in deposition.file (bed_hash)

  bool operator==(const MemberOrigin&) const = default;
};

/// A scenario with the changes of one variant.
struct Variant {
  std::string name;             ///< for example "baseline", "wbc-100": the folder of its runs; empty: none
  std::string scenario_file;    ///< path, as for `talus run`
  scenario::Scenario scenario;  ///< parsed scenario; its seed is not used
  std::string full_name = {};   ///< full printable name if `name` was shortened
  MemberOrigin origin = {};
};

/// One run of the plan.
struct Member {
  std::size_t variant = 0;  ///< index into EnsemblePlan::variants
  std::uint64_t seed = 0;
  std::string name;             ///< for example "baseline/seed-1" or "seed-1"
  std::string path;             ///< run file: the name with ".h5" below the folder of the ensemble
  scenario::Scenario scenario;  ///< scenario of the variant with the member's seed
  MemberOrigin origin = {};
};

struct EnsemblePlan {
  std::vector<std::uint64_t> seeds;  ///< ascending
  std::vector<Variant> variants;
  std::vector<Member> members;  ///< ordered by seed, then by variant
};

/// Parses the seeds of "1-4", "7" or "1-3,8"; returns them in ascending order, each once. Throws Error(usage)
/// if there are too many, or if one exceeds the largest seed of a scenario.
std::vector<std::uint64_t> parse_seeds(const std::string& text);

/// Returns the plan with every variant and seed, in files below `folder`.
EnsemblePlan plan_ensemble(std::vector<std::uint64_t> seeds, std::vector<Variant> variants,
                           const std::string& folder);

/// Estimates the wall time of a member of each variant, s; 0 for a bed that cannot be made, which its members
/// report.
std::vector<double> estimated_seconds(const EnsemblePlan& plan);

/// Splits `text` at separators; an empty text gives one empty part.
std::vector<std::string> split(const std::string& text, char separator);

/// Returns the path of a member's run file with another extension, such as ".log".
std::string path_with_extension(const std::string& path, const char* ending);

}  // namespace talus::ensemble
