#include "ensemble/kept_runs.h"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <fmt/core.h>
#include <optional>

#include "base/errors.h"
#include "base/locked_file.h"
#include "base/paths.h"
#include "base/visible_text.h"
#include "ensemble/claim.h"
#include "io/analysis_file.h"
#include "io/run_store.h"

namespace talus::ensemble {
namespace {

/// Returns the number of runs that are kept; nothing means all.
std::optional<std::size_t> kept_count(const std::string& keep) {
  if (keep.empty() || keep == "all") return std::nullopt;
  if (keep == "analysis") return 0;
  std::size_t number = 0;
  const char* const last = keep.data() + keep.size();
  const auto [end, error] = std::from_chars(keep.data(), last, number);
  if (error == std::errc() && end == last) return number;
  throw Error(ExitCode::usage,
              fmt::format("--keep {}: expected all, analysis, or the number of seeds whose runs are kept",
                          visible_word(keep)));
}

/// Removes the folder of a packed run unless another process uses it; a folder that remains is harmless.
void discard_packed(const std::string& run) try {
  if (io::run_presence(run) == io::RunPresence::packed) io::discard_folder(run);
} catch (const Error& error) {
  if (error.code() != ExitCode::cannot_create) throw;
}

}  // namespace

void check_keep(const std::string& keep) { kept_count(keep); }

bool keeps_frames(const EnsembleManifest& manifest, std::uint64_t seed) {
  const std::optional<std::size_t> kept = kept_count(manifest.keep);
  if (!kept) return true;
  const auto before = std::ranges::lower_bound(manifest.seeds, seed) - manifest.seeds.begin();
  return static_cast<std::size_t>(before) < *kept;
}

bool is_in_folder(const Member& member, const std::string& folder) {
  return resolved_path(member.path).starts_with(resolved_path(folder) + "/");
}

std::size_t drop_frames(const EnsembleManifest& manifest, const EnsemblePlan& plan, const std::string& folder,
                        KnownMembers& known) {
  if (!kept_count(manifest.keep)) return 0;
  std::size_t dropped = 0;
  for (const std::size_t m : done_members(plan)) {
    const Member& member = plan.members[m];
    if (keeps_frames(manifest, member.seed) || !is_in_folder(member, folder)) continue;
    try {
      const MemberResult& result = analysed_member(member, known);
      if (!result.has_frames) continue;
      const std::optional<analysis::Analysis> analysis = io::read_analysis(member.path);
      if (!analysis) continue;
      io::store_analysis(member.path, *analysis, result.numbers.state_hash, analysis::quantities(), false);
      ++dropped;
    } catch (const Error&) {
      continue;  // it is reported with the averages
    }
  }
  return dropped;
}

void drop_leftovers(const EnsemblePlan& plan) {
  const std::vector<MemberState> states = scan_members(plan);
  for (std::size_t m = 0; m < states.size(); ++m) {
    const std::string& path = plan.members[m].path;
    if (states[m].stage == MemberStage::done && states[m].has_folder) discard_packed(path);
    if (!states[m].claim) continue;
    if (states[m].stage != MemberStage::done && states[m].stage != MemberStage::failed) continue;
    for (const std::string& claim : claims_of(path))
      if (!is_locked(claim).value_or(false)) ::unlink(claim.c_str());
  }
}

}  // namespace talus::ensemble
