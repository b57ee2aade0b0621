#include "app/ensemble_workers.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fmt/core.h>
#include <thread>
#include <vector>

#include "app/ensemble_report.h"
#include "app/progress.h"
#include "app/run_files.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/output_file.h"
#include "base/text.h"
#include "ensemble/ensemble_manifest.h"
#include "ensemble/member_state.h"
#include "ensemble/worker.h"
#include "io/run_folder.h"
#include "io/run_store.h"

namespace talus::app {
namespace {

double estimate_of(const ensemble::EnsemblePlan& plan, const std::vector<ensemble::MemberState>& states,
                   ensemble::MemberStage stage) {
  const std::vector<double> variant_seconds = ensemble::estimated_seconds(plan);
  double seconds = 0.0;
  for (std::size_t m = 0; m < plan.members.size(); ++m)
    if (states[m].stage == stage) seconds += variant_seconds[plan.members[m].variant];
  return seconds;
}

/// Returns "seed-3 waits for process 12 on host a" for the first member that waits until the writer of its
/// run has ended; empty without such a member.
std::string wait_text(const ensemble::EnsemblePlan& plan, const std::vector<ensemble::MemberState>& states) {
  for (std::size_t m = 0; m < states.size(); ++m)
    if (states[m].stage == ensemble::MemberStage::waiting)
      if (const std::string writer = io::writer_of(io::run_folder(plan.members[m].path)); !writer.empty())
        return fmt::format("{} waits for {}", visible(plan.members[m].name), visible(writer));
  return "";
}

/// Shows "ensemble: 3 of 50 members done, 2 under way, 1 failed", the fraction done, and the remaining time,
/// extrapolated from the members that finished since the line was started. `before`: estimate (s) for those
/// done before.
void show(StatusLine& line, const ensemble::EnsemblePlan& plan, double before) {
  const std::vector<ensemble::MemberState> states = ensemble::scan_members(plan);
  const std::size_t done = ensemble::count_of(states, ensemble::MemberStage::done),
                    failed = ensemble::count_of(states, ensemble::MemberStage::failed);
  const double finished = estimate_of(plan, states, ensemble::MemberStage::done) - before;
  const double left = estimate_of(plan, states, ensemble::MemberStage::waiting) +
                      estimate_of(plan, states, ensemble::MemberStage::claimed);
  const std::string failures = failed > 0 ? fmt::format(", {} failed", failed) : "";
  Progress progress{fmt::format("ensemble: {} of {} members done, {} under way{}", done, states.size(),
                                ensemble::count_of(states, ensemble::MemberStage::claimed), failures),
                    static_cast<double>(done) / static_cast<double>(states.size()),
                    line.elapsed(),
                    {}};
  if (finished > 0.0) progress.remaining = progress.elapsed * left / finished;
  if (const std::string wait = wait_text(plan, states); !wait.empty()) progress.more = {{wait, 1}};
  line.show(progress);
}

/// State of the intermediate averages: the number of members included, and when they were written.
struct IntermediateAverages {
  std::size_t members = 0;
  std::chrono::steady_clock::time_point made = std::chrono::steady_clock::now();
  std::chrono::steady_clock::duration interval = std::chrono::minutes(1);
};

/// Updates the averages at most once a minute, if more members are done; less often if there are many
/// members, so that it uses at most a twentieth of this process's time.
void renew(IntermediateAverages& averages, const std::string& folder, ensemble::KnownMembers& known) {
  const auto now = std::chrono::steady_clock::now();
  if (now - averages.made < averages.interval) return;
  averages.made = now;
  const std::size_t done =
      ensemble::count_of(ensemble::scan_members(ensemble::plan_of(ensemble::read_ensemble(folder), folder)),
                         ensemble::MemberStage::done);
  if (done == averages.members) return;
  averages.members = done;
  try {
    write_averages(folder, known);
  } catch (const Error&) {
    return;  // a rejected table stops no member under way; it is reported at the end
  }
  averages.made = std::chrono::steady_clock::now();
  averages.interval =
      std::max<std::chrono::steady_clock::duration>(std::chrono::minutes(1), 20 * (averages.made - now));
}

std::vector<std::string> worker_words(const EnsembleWorkers& workers) {
  std::vector<std::string> words = {"ensemble", "work", ensemble::path_word(workers.folder), "--stale",
                                    fmt::format("{}", workers.times.stale)};
  if (!workers.max_wall.empty()) words.insert(words.end(), {"--max-wall", workers.max_wall});
  return words;
}

/// Runs workers in parallel until no member is left that they can start. Returns those with an error.
std::vector<ensemble::FailedJob> run_workers(const EnsembleWorkers& workers,
                                             const ensemble::EnsemblePlan& plan,
                                             ensemble::KnownMembers& known) {
  const std::vector<ensemble::MemberState> states = ensemble::scan_members(plan);
  const std::size_t missing = states.size() - ensemble::count_of(states, ensemble::MemberStage::done) -
                              ensemble::count_of(states, ensemble::MemberStage::failed);
  if (missing == 0) return {};
  std::vector<ensemble::Job> jobs;
  for (std::size_t k = 1; k <= std::min<std::size_t>(missing, static_cast<std::size_t>(workers.jobs)); ++k) {
    const std::string name = fmt::format("worker-{}", k);
    jobs.push_back({worker_words(workers),
                    (std::filesystem::path(workers.folder) / "workers" / (name + ".log")).string()});
  }
  const double before = estimate_of(plan, states, ensemble::MemberStage::done);
  StatusLine line(false, 2.0, 60.0);  // scanning ten thousand members takes a few hundredths of a second
  IntermediateAverages averages{ensemble::count_of(states, ensemble::MemberStage::done)};
  const auto show_now_and_then = [&] {
    renew(averages, workers.folder, known);
    if (line.is_due()) show(line, plan, before);
    return true;
  };
  std::vector<ensemble::FailedJob> failed = ensemble::run_jobs(jobs, "the ensemble", show_now_and_then);
  line.finish();
  const bool stopped = std::ranges::any_of(failed, [](const ensemble::FailedJob& worker) {
    return worker.exit_code == static_cast<int>(ExitCode::stopped);
  });
  if (stopped) throw Error(ExitCode::stopped, "the ensemble was stopped; repeat the command to continue");
  return failed;
}

}  // namespace

std::size_t restart_damaged_members(const ensemble::EnsemblePlan& plan, ensemble::KnownMembers& known) {
  std::vector<ensemble::MemberState> states = ensemble::scan_members(plan);
  ensemble::find_damage(plan, states, known);
  std::size_t count = 0;
  for (std::size_t m = 0; m < states.size(); ++m) {
    if (states[m].damage.empty()) continue;
    if (const std::string damage = io::set_damaged_aside(plan.members[m].path); !damage.empty())
      print_error("talus: note: {}; the member is restarted\n", damage);
    ++count;
  }
  return count;
}

void compute_members(const EnsembleWorkers& workers, ensemble::KnownMembers& known) {
  ensemble::ClaimWatch watch{workers.times, {}};
  for (std::size_t ended = 0;;) {
    const ensemble::EnsemblePlan plan =
        ensemble::plan_of(ensemble::read_ensemble(workers.folder), workers.folder);
    restart_damaged_members(plan, known);
    std::vector<ensemble::FailedJob> killed;
    if (ensemble::has_work(plan, ensemble::scan_members(plan), watch))
      killed = run_workers(workers, plan, known);
    const EnsembleView view = view_of_ensemble(workers.folder, known);
    const std::size_t ended_now = count_ended(view);
    if (ended_now == view.states.size()) return;
    const bool limited = !workers.max_wall.empty();
    if (!killed.empty() && (limited || ended_now == ended))
      ensemble::refuse(killed, "and no member finished in the meantime");
    if (limited) return;
    ended = ended_now;
    std::this_thread::sleep_for(std::chrono::seconds(1));
  }
}

void drop_old_frames(const std::string& folder, ensemble::KnownMembers& known) {
  const ensemble::EnsembleManifest manifest = ensemble::read_ensemble(folder);
  const ensemble::EnsemblePlan plan = ensemble::plan_of(manifest, folder);
  ensemble::drop_leftovers(plan);
  if (const std::size_t dropped = ensemble::drop_frames(manifest, plan, folder, known); dropped > 0)
    print_error(
        "talus: note: the frames of {} member{} that {} done were removed (--keep {}); all other data are "
        "kept\n",
        dropped, dropped == 1 ? "" : "s", dropped == 1 ? "is" : "are", visible_word(manifest.keep));
}

/// Reports variants that a corrected command has withdrawn from an ensemble.
static void report_withdrawn(const std::vector<ensemble::Variant>& before,
                             const std::vector<ensemble::Variant>& now) {
  for (const ensemble::Variant& variant : before)
    if (std::ranges::find(now, variant.name, &ensemble::Variant::name) == now.end())
      print_error("talus: note: {} is withdrawn from the ensemble: none of its members could be computed\n",
                  variant.name.empty() ? "the earlier scenario" : variant.name);
}

void begin_ensemble(const std::string& folder, const ensemble::EnsembleManifest& wanted,
                    const std::vector<std::string>& inputs, ensemble::KnownMembers& known) {
  const bool is_new = !ensemble::is_ensemble(folder);
  ensemble::EnsembleManifest asked = wanted;
  ensemble::hash_beds(asked.variants, folder);
  if (is_new)
    for (const ensemble::Member& member : ensemble::plan_of(asked, folder).members)
      ensemble::is_complete(member);
  const std::vector<ensemble::Variant> before =
      is_new ? std::vector<ensemble::Variant>() : ensemble::read_ensemble(folder).variants;
  prepare_folder(folder);
  for (const char* name : {"members.csv", "averages.csv", "ensemble.h5"})
    output_target((std::filesystem::path(folder) / name).string(), {true, inputs});
  report_withdrawn(before, ensemble::extend_ensemble(folder, asked).variants);
  note_missing_locks();
  drop_old_frames(folder, known);
}

EnsembleView compute_ensemble(const ensemble::EnsembleManifest& wanted, const EnsembleWorkers& workers,
                              const std::vector<std::string>& inputs) {
  ensemble::KnownMembers known;
  begin_ensemble(workers.folder, wanted, inputs, known);
  if (workers.jobs > 0) compute_members(workers, known);
  drop_old_frames(workers.folder, known);
  return write_averages(workers.folder, known);
}

void refuse_failures(const ensemble::EnsemblePlan& plan, const std::string& consequence) {
  const std::vector<ensemble::MemberState> states = ensemble::scan_members(plan);
  std::vector<ensemble::FailedJob> failed;
  for (std::size_t m = 0; m < states.size(); ++m) {
    if (states[m].stage != ensemble::MemberStage::failed) continue;
    const ensemble::MemberFailure failure = ensemble::read_failure(plan.members[m].path);
    failed.push_back(
        {ensemble::path_with_extension(plan.members[m].path, ".log"), failure.exit_code, failure.message});
  }
  if (failed.empty()) return;
  const char* const them = failed.size() == 1 ? "it" : "them";
  ensemble::refuse(failed, fmt::format("{} until talus ensemble retry queues {} again", consequence, them));
}

void on_wait(const std::string& member, const std::string& writer) {
  print_error("talus: note: {} is postponed: {} is writing its run\n", member, writer);
}

}  // namespace talus::app
