#pragma once
/// The plan of an ensemble: variants of a scenario, which differ in the keys that vary, each with the same
/// seeds; and the beds of the paper as such variants.

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

/// Largest number of variants.
inline constexpr std::size_t max_variants = 10000;

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

/// Returns the settings for each value of an axis. "tilt.step=0.002,0.0005" gives {tilt.step=0.002} and
/// {tilt.step=0.0005}. Keys joined by colons change together: "tilt.rate:tilt.step=2:0.002,0.5:0.0005" gives
/// {tilt.rate=2, tilt.step=0.002} and {tilt.rate=0.5, tilt.step=0.0005}. A TOML value counts as one value, as
/// in `--set`: a comma or colon inside a string, an array, an inline table or a date does not end it. A
/// single key may have a range, "contact.friction=0.2:0.6:0.1": first and last value, and step. Throws
/// Error(usage) if the text has another form; keys and values are not checked.
std::vector<std::vector<std::string>> parse_axis(const std::string& axis);

/// Returns the periodic bed with three preparations (deposition.method: poured, geometric, collapse), the
/// paper's first, and five beds between walls. `quick`: H = 20 D, with L = 50 ... 150 D between walls, which
/// keeps the paper's H / L, and L = 100 D for the periodic bed.
std::vector<Variant> paper_beds(bool quick);

/// Returns the variants of a scenario: one for each combination of values of the axes
/// ("contact.friction=0.3,0.5"), named by its values. Without axes it returns the scenario itself, without a
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

}  // namespace talus::ensemble
