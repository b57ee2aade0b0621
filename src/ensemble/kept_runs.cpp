#include "ensemble/kept_runs.h"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <fmt/core.h>
#include <optional>

#include "core/errors.h"
#include "core/locked_file.h"
#include "core/paths.h"
#include "core/visible_text.h"
#include "ensemble/claim.h"
#include "ensemble/member_lists.h"
#include "ensemble/member_series.h"
#include "io/durable_file.h"
#include "io/run_file.h"
#include "io/run_store.h"
#include "session/run_header.h"

namespace talus {
namespace {

/// How many runs stay; nothing: all.
std::optional<std::size_t> number_kept(const std::string& keep) {
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

/// Whether the run at the place of a member is that of another scenario or seed, which is not removed. A
/// damaged one does not tell.
bool has_run_of_another(const Member& member) {
  try {
    return stored_scenario(RunFile::open(member.path).header(), member.path) != member.scenario;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

void check_keep(const std::string& keep) { number_kept(keep); }

bool keeps_run(const EnsembleManifest& manifest, std::uint64_t seed) {
  const std::optional<std::size_t> kept = number_kept(manifest.keep);
  if (!kept) return true;
  const auto before = std::ranges::lower_bound(manifest.seeds, seed) - manifest.seeds.begin();
  return static_cast<std::size_t>(before) < *kept;
}

bool is_in_folder(const Member& member, const std::string& folder) {
  return resolved_path(member.path).starts_with(resolved_path(folder) + "/");
}

void drop_run(const Member& member) {
  discard_folder(member.path);  // while its file is there: without it, it would be taken for a run under way
  remove_file(member.path);
}

void refuse_missing_series(const Member& member) {
  throw Error(
      ExitCode::missing_input,
      fmt::format("{} is not there, nor the run that it could be made from; remove {}, and the next worker "
                  "computes the member again",
                  series_path(member.path), numbers_path(member.path)));
}

std::size_t drop_runs(const EnsembleManifest& manifest, const EnsemblePlan& plan, const std::string& folder) {
  if (!number_kept(manifest.keep)) return 0;
  const std::vector<MemberState> states = look_at_members(plan);
  std::size_t dropped = 0;
  for (std::size_t m = 0; m < states.size(); ++m) {
    const Member& member = plan.members[m];
    if (states[m].stage != MemberStage::done || !states[m].has_run || keeps_run(manifest, member.seed))
      continue;
    if (!is_there(series_path(member.path)) || !is_there(lists_path(member.path))) continue;
    if (!is_in_folder(member, folder) || has_run_of_another(member)) continue;
    drop_run(member);
    ++dropped;
  }
  return dropped;
}

void drop_claims(const EnsemblePlan& plan) {
  const std::vector<MemberState> states = look_at_members(plan);
  for (std::size_t m = 0; m < states.size(); ++m) {
    if (!states[m].claim) continue;
    if (states[m].stage != MemberStage::done && states[m].stage != MemberStage::failed) continue;
    for (const std::string& claim : claims_of(plan.members[m].path))
      if (!is_locked(claim).value_or(false)) ::unlink(claim.c_str());
  }
}

}  // namespace talus
