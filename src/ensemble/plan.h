#pragma once
/// Many runs as a plan: variants of a scenario, each with the same seeds.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "scenario/scenario.h"

namespace talus::ensemble {

/// What the members of a variant are computed from, as hashes; empty: not known.
struct MemberOrigin {
  std::string scenario = {};  ///< of the scenario file of the variant, in the folder of the ensemble
  std::string bed = {};       ///< of the bed that deposition.file holds (bed_hash)

  bool operator==(const MemberOrigin&) const = default;
};

/// A scenario with all that is changed in it.
struct Variant {
  std::string name;             ///< "baseline", "wbc-100": the folder of its runs; empty: none
  std::string scenario_file;    ///< as `talus run` reads it
  scenario::Scenario scenario;  ///< what it says; its seed is not used
  std::string full_name = {};   ///< where `name` was shortened: all of it, fit to be shown
  MemberOrigin origin = {};
};

/// One run of the plan.
struct Member {
  std::size_t variant = 0;  ///< index into EnsemblePlan::variants
  std::uint64_t seed = 0;
  std::string name;             ///< "baseline/seed-1", "seed-1"
  std::string path;             ///< its run file: the name below the folder of the ensemble, with ".h5"
  scenario::Scenario scenario;  ///< with the seed
  MemberOrigin origin = {};
};

struct EnsemblePlan {
  std::vector<std::uint64_t> seeds;  ///< ascending
  std::vector<Variant> variants;
  std::vector<Member> members;  ///< seed by seed, in each the variants in their order
};

/// The seeds of "1-4", "7" or "1-3,8", ascending and each once: as many as an ensemble may have, none above
/// what a scenario may have. Throws Error(usage).
std::vector<std::uint64_t> parse_seeds(const std::string& text);

/// Every variant with every seed, in files below `folder`.
EnsemblePlan plan_ensemble(std::vector<std::uint64_t> seeds, std::vector<Variant> variants,
                           const std::string& folder);

/// How long a member of each variant takes, s; 0 for a bed that cannot be made, which its members report.
std::vector<double> estimated_seconds(const EnsemblePlan& plan);

/// `text` between separators; an empty text has one empty part.
std::vector<std::string> split(const std::string& text, char separator);

/// The file beside that of a member with another ending: ".log".
std::string file_beside(const std::string& path, const char* ending);

}  // namespace talus::ensemble
