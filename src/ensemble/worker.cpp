#include "ensemble/worker.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fmt/core.h>
#include <map>
#include <numeric>
#include <set>
#include <thread>

#include "base/errors.h"
#include "ensemble/ensemble_manifest.h"
#include "ensemble/member_state.h"
#include "ensemble/pool.h"
#include "ensemble/until.h"
#include "io/run_store.h"
#include "io/writer_lock.h"

namespace talus::ensemble {
namespace {

using Clock = std::chrono::steady_clock;

/// State of a worker.
struct Worker {
  const WorkerOptions& options;
  ClaimWatch watch;
  std::map<std::string, std::string> waits_for = {};  ///< last reported writer of the run of each member
  std::set<std::string> refused = {};                 ///< members that have ended once with exit code 73
  KnownMembers known = {};
  Clock::time_point begin = Clock::now();
  WorkerEnd end = {};
};

/// Returns the members by descending estimated time; equal times keep the order of the plan.
std::vector<std::size_t> longest_first(const EnsemblePlan& plan) {
  const std::vector<double> variant_seconds = estimated_seconds(plan);
  std::vector<std::size_t> order(plan.members.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater<>(),
                           [&](std::size_t m) { return variant_seconds[plan.members[m].variant]; });
  return order;
}

struct ClaimedMember {
  Member member;
  Claim claim;
};

/// Whether a newly acquired claim is valid, for a member that still has to be computed.
bool is_valid_claim(const EnsemblePlan& plan, std::size_t member, const Claim& claim) {
  const MemberState now = scan_members(plan)[member];
  return now.stage == MemberStage::claimed && now.claim == claim.number();
}

/// Whether another process writes the run of a member, such as `talus run --resume`, or a process whose
/// worker was considered dead. Reports each new writer.
bool is_written(const Member& member, Worker& worker) {
  const std::string writer = io::writer_of(io::run_folder(member.path));
  if (writer.empty()) {
    worker.waits_for.erase(member.name);
    return false;
  }
  std::string& reported = worker.waits_for[member.name];
  if (reported != writer && worker.options.on_wait) worker.options.on_wait(member.name, writer);
  reported = writer;
  return true;
}

/// The result of scanning all members.
struct Scan {
  std::optional<ClaimedMember> claimed;
  std::size_t alive = 0;
  std::size_t unknown = 0;  ///< claims that must be watched for longer
  std::size_t written = 0;  ///< members whose runs other processes write, to be awaited
};

Scan claim_next(const EnsemblePlan& plan, const std::vector<MemberState>& states, Worker& worker) {
  Scan scan;
  for (const std::size_t m : longest_first(plan)) {
    const Member& member = plan.members[m];
    const MemberState& state = states[m];
    if (!worker.options.only.empty() && member.name != worker.options.only) continue;
    if (state.stage == MemberStage::done || state.stage == MemberStage::failed) continue;
    if (state.claim) {
      const ClaimState claim = claim_state(member.path, *state.claim, worker.watch);
      if (claim == ClaimState::alive) ++scan.alive;
      if (claim == ClaimState::unknown) ++scan.unknown;
      if (claim != ClaimState::dead) continue;
    }
    if (is_written(member, worker)) {
      ++scan.written;
      continue;
    }
    std::optional<Claim> claim = Claim::take(member.path, state.claim, worker.options.times);
    if (!claim || !is_valid_claim(plan, m, *claim)) continue;
    scan.claimed.emplace(ClaimedMember{member, std::move(*claim)});
    return scan;
  }
  return scan;
}

/// Returns the remaining time of the worker, formatted for talus; nothing without a limit.
std::optional<std::string> time_left(const Worker& worker) {
  if (!worker.options.max_wall) return std::nullopt;
  const double left =
      *worker.options.max_wall - std::chrono::duration<double>(Clock::now() - worker.begin).count();
  const auto seconds = static_cast<long>(left);
  if (seconds < 1) throw Error(ExitCode::stopped, "the worker was stopped for --max-wall");
  return fmt::format("{:02}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

/// Computes and analyses the member in another process, and keeps the claim alive meanwhile.
void compute(Worker& worker, ClaimedMember& claimed) {
  const Member& member = claimed.member;
  std::vector<std::string> arguments = {"ensemble", "member", path_word(worker.options.folder),
                                        path_word(member.name)};
  if (const std::optional<std::string> left = time_left(worker)) {
    arguments.emplace_back("--max-wall");
    arguments.push_back(*left);
  }
  if (worker.options.on_change) worker.options.on_change(member.name, -1);
  bool lost = false;
  const auto keep_claim = [&] { return !(lost = lost || !claimed.claim.record_heartbeat()); };
  const std::vector<FailedJob> failed =
      run_jobs({{std::move(arguments), path_with_extension(member.path, ".log")}}, "the worker", keep_claim);
  const int code = failed.empty() ? 0 : failed.front().exit_code;
  // Another worker continues the member, so that the error of a process that was considered dead does not
  // count as a failure.
  if (lost || (code != 0 && !claimed.claim.record_heartbeat())) return;
  if (worker.options.on_change) worker.options.on_change(member.name, code);
  if (code == static_cast<int>(ExitCode::stopped))
    throw Error(ExitCode::stopped,
                "the worker was stopped; the members under way resume from their checkpoints");
  if (code == 0) {
    ++worker.end.done;
    return;
  }
  // Another process was writing the run, perhaps one whose worker was considered dead; the first time does
  // not count as a failure either.
  if (code == static_cast<int>(ExitCode::cannot_create) && worker.refused.insert(member.name).second) return;
  // A signal to all processes of a job also ends this worker, perhaps a moment after its member. In that case
  // the member has not failed.
  if (code > 128) std::this_thread::sleep_for(std::chrono::seconds(1));
  record_failure(member.path, {code, failed.front().message});
  ++worker.end.failed;
}

}  // namespace

bool has_work(const EnsemblePlan& plan, const std::vector<MemberState>& states, ClaimWatch& watch) {
  for (std::size_t m = 0; m < states.size(); ++m) {
    if (states[m].stage == MemberStage::waiting) return true;
    if (states[m].stage == MemberStage::claimed &&
        claim_state(plan.members[m].path, *states[m].claim, watch) == ClaimState::dead)
      return true;
  }
  return false;
}

WorkerEnd work_on_ensemble(const WorkerOptions& options) {
  Worker worker{options, {options.times, {}}};
  for (;;) {
    const EnsembleManifest manifest = read_ensemble(options.folder);
    const EnsemblePlan plan = plan_of(manifest, options.folder);
    std::vector<MemberState> states = scan_members(plan);
    if (!manifest.until.empty()) find_damage(plan, states, worker.known);
    worker.end.enough = !manifest.until.empty() && is_reached(parse_precision(manifest.until), plan,
                                                              numbers_of(plan, states, worker.known));
    if (worker.end.enough) return worker.end;
    Scan scan = claim_next(plan, states, worker);
    worker.end.elsewhere = scan.alive + scan.unknown + scan.written;
    if (scan.claimed)
      compute(worker, *scan.claimed);
    else if (scan.unknown + scan.written == 0)
      return worker.end;
    else {
      time_left(worker);  // throws when the time is over
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
  }
}

}  // namespace talus::ensemble
