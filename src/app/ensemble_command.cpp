/// `talus ensemble`: many beds from one scenario, computed by any number of processes that share a folder.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fmt/core.h>
#include <memory>
#include <thread>

#include "app/analysed_run.h"
#include "app/command_line.h"
#include "app/commands.h"
#include "app/ensemble_averages.h"
#include "app/ensemble_report.h"
#include "app/open_run.h"
#include "app/pool_line.h"
#include "app/progress_text.h"
#include "app/status_line.h"
#include "app/stop_signals.h"
#include "app/wall_time.h"
#include "core/errors.h"
#include "core/output_file.h"
#include "core/text.h"
#include "ensemble/until.h"
#include "ensemble/worker.h"
#include "io/durable_file.h"
#include "io/run_file.h"
#include "session/analysis_parameters.h"
#include "session/estimate.h"

namespace talus {
namespace {

struct EnsembleArguments {
  std::string scenario;
  std::string folder;
  std::string member;
  std::string seeds = "1-4";
  std::vector<std::string> axes;
  std::vector<std::string> settings;
  std::string until;
  std::string max_wall;  ///< HH:MM; empty: no limit
  ClaimTimes times;
  int jobs = default_jobs();
  bool json = false;
};

/// What tells how long the rest will take: the members that came to an end since `begin`, by their estimates.
struct EnsemblePace {
  double estimate_before = 0.0;  ///< s, of the members that were done before
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
};

double estimate_of(const EnsemblePlan& plan, const std::vector<MemberState>& states, MemberStage stage) {
  std::vector<double> of_variant;
  for (const Variant& variant : plan.variants) of_variant.push_back(estimate(variant.scenario).seconds);
  double seconds = 0.0;
  for (std::size_t m = 0; m < plan.members.size(); ++m)
    if (states[m].stage == stage) seconds += of_variant[plan.members[m].variant];
  return seconds;
}

/// "ensemble: 3 of 50 members done, 2 under way, 1 failed", how far that is, and how long it still takes.
void show(StatusLine& line, const EnsemblePlan& plan, const EnsemblePace& pace) {
  const std::vector<MemberState> states = look_at_members(plan);
  const std::size_t done = count_of(states, MemberStage::done),
                    failed = count_of(states, MemberStage::failed);
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - pace.begin).count();
  const double finished = estimate_of(plan, states, MemberStage::done) - pace.estimate_before;
  const double left =
      estimate_of(plan, states, MemberStage::waiting) + estimate_of(plan, states, MemberStage::claimed);
  std::optional<double> remaining;
  if (finished > 0.0) remaining = elapsed * left / finished;
  std::vector<ProgressField> fields = progress_fields(
      static_cast<double>(done) / static_cast<double>(states.size()), elapsed, remaining, line.on_terminal());
  const std::string failures = failed > 0 ? fmt::format(", {} failed", failed) : "";
  fields.insert(fields.begin(), {fmt::format("ensemble: {} of {} members done, {} under way{}", done,
                                             states.size(), count_of(states, MemberStage::claimed), failures),
                                 0});
  line.show(fitted_line(fields, line.width()));
}

/// The averages while members come in: of how many, and when.
struct AveragesOnTheWay {
  std::size_t members = 0;
  std::chrono::steady_clock::time_point made = std::chrono::steady_clock::now();
};

/// Makes them anew once a minute, where more members are done than before.
void renew(AveragesOnTheWay& averages, const std::string& folder) {
  const auto now = std::chrono::steady_clock::now();
  if (now - averages.made < std::chrono::minutes(1)) return;
  averages.made = now;
  const EnsembleView view = view_of_ensemble(folder);
  const std::size_t done = count_of(view.states, MemberStage::done);
  if (done == averages.members) return;
  averages.members = done;
  write_averages(view);
}

std::vector<std::string> worker_words(const EnsembleArguments& arguments) {
  std::vector<std::string> words = {"ensemble", "work", path_word(arguments.folder), "--stale",
                                    fmt::format("{}", arguments.times.stale)};
  if (!arguments.max_wall.empty()) words.insert(words.end(), {"--max-wall", arguments.max_wall});
  return words;
}

/// Workers side by side, until nothing is left that they can begin. Returns those that ended with an error.
std::vector<FailedJob> run_workers(const EnsembleArguments& arguments, const EnsemblePlan& plan) {
  const std::vector<MemberState> states = look_at_members(plan);
  const std::size_t missing =
      states.size() - count_of(states, MemberStage::done) - count_of(states, MemberStage::failed);
  if (missing == 0) return {};
  std::vector<Job> workers;
  for (std::size_t k = 1; k <= std::min<std::size_t>(missing, static_cast<std::size_t>(arguments.jobs));
       ++k) {
    const std::string name = fmt::format("worker-{}", k);
    workers.push_back({name, worker_words(arguments),
                       (std::filesystem::path(arguments.folder) / "workers" / (name + ".log")).string(),
                       0.0});
  }
  const EnsemblePace pace{estimate_of(plan, states, MemberStage::done)};
  StatusLine line(false, 60.0);
  AveragesOnTheWay averages{count_of(states, MemberStage::done)};
  auto shown = pace.begin;  // a look at ten thousand members takes some hundredths of a second
  const auto show_now_and_then = [&](const PoolProgress&) {
    renew(averages, arguments.folder);
    const bool on_time = std::chrono::steady_clock::now() - shown > std::chrono::seconds(2);
    if (!(line.on_terminal() ? on_time : line.is_due())) return;
    shown = std::chrono::steady_clock::now();
    show(line, plan, pace);
  };
  std::vector<FailedJob> failed =
      run_jobs(workers, {"ensemble", arguments.jobs, workers.size(), show_now_and_then});
  line.finish();
  const bool stopped = std::ranges::any_of(failed, [](const FailedJob& worker) {
    return worker.exit_code == static_cast<int>(ExitCode::stopped);
  });
  if (stopped) throw Error(ExitCode::stopped, "the ensemble was stopped; repeat the command to continue");
  return failed;
}

/// Members that will not be begun any more: done, failed, or not needed for the precision that was asked for.
std::size_t count_ended(const EnsembleView& view) {
  const std::string& until = view.manifest.until;
  if (!until.empty() && is_reached(parse_precision(until), view.plan, view.numbers))
    return view.states.size();
  return count_of(view.states, MemberStage::done) + count_of(view.states, MemberStage::failed);
}

/// Members that others compute are waited for, and taken over where their workers end before them; workers
/// that were killed are replaced, as long as members come to an end. With a limit of time others are left
/// alone.
void compute_members(const EnsembleArguments& arguments) {
  ClaimWatch watch{arguments.times, {}};
  for (std::size_t ended = 0;;) {
    const EnsemblePlan plan = plan_of(read_ensemble(arguments.folder), arguments.folder);
    std::vector<FailedJob> killed;
    if (has_work(plan, look_at_members(plan), watch)) killed = run_workers(arguments, plan);
    const EnsembleView view = view_of_ensemble(arguments.folder);
    const std::size_t ended_now = count_ended(view);
    if (ended_now == view.states.size()) return;
    const bool limited = !arguments.max_wall.empty();
    if (!killed.empty() && (limited || ended_now == ended))
      refuse(killed, "and no member came to an end meanwhile");
    if (limited) return;
    ended = ended_now;
    std::this_thread::sleep_for(std::chrono::seconds(1));
  }
}

/// The exit code of an ensemble in which members failed is that of the first.
void refuse_failures(const EnsembleView& view) {
  std::vector<FailedJob> failed;
  for (std::size_t m = 0; m < view.states.size(); ++m)
    if (view.states[m].stage == MemberStage::failed)
      failed.push_back({file_beside(view.plan.members[m].path, ".log"),
                        read_failure(view.plan.members[m].path).exit_code});
  if (!failed.empty()) refuse(failed, "left out of the means");
}

void run_ensemble(const EnsembleArguments& arguments) {
  if (arguments.scenario.empty() || arguments.folder.empty())
    throw Error(ExitCode::usage,
                "expected a scenario and a folder: talus ensemble SCENARIO --seeds 1-50 -o FOLDER");
  if (!arguments.until.empty()) parse_precision(arguments.until);
  const EnsembleManifest wanted{"", parse_seeds(arguments.seeds), arguments.until,
                                plan_variants(arguments.scenario, arguments.settings, arguments.axes)};
  prepare_folder(arguments.folder);
  for (const char* name : {"members.csv", "averages.csv", "ensemble.h5"})
    output_target((std::filesystem::path(arguments.folder) / name).string(), {true, {arguments.scenario}});
  extend_ensemble(arguments.folder, wanted);
  compute_members(arguments);
  const EnsembleView view = view_of_ensemble(arguments.folder);
  write_averages(view);
  std::printf("%s", (arguments.json ? ensemble_json(view) + "\n" : ensemble_text(view)).c_str());
  refuse_failures(view);
}

/// Runs or resumes a member, analyses it, and leaves its numbers beside it: the last of which makes it done.
void compute_member(const EnsembleArguments& arguments) {
  const EnsemblePlan plan = plan_of(read_ensemble(arguments.folder), arguments.folder);
  const auto member = std::ranges::find(plan.members, arguments.member, &Member::name);
  if (member == plan.members.end())
    throw Error(ExitCode::usage, fmt::format("{} has no member {}", arguments.folder, arguments.member));
  if (!is_complete(*member, "ensemble")) {
    RunControl control;
    control.stop = stop_request();
    if (!arguments.max_wall.empty()) control.max_wall = parse_wall_time("--max-wall", arguments.max_wall);
    RunRequest request{
        plan.variants[member->variant].scenario_file, member->path, {}, 1, false, command_line()};
    request.settings.push_back(fmt::format("seed={}", member->seed));
    OpenRun open =
        run_presence(member->path) == RunPresence::folder ? resume_run(request) : start_run(request);
    open.session.use_threads(1);
    const CommitOnSignals commit;
    if (run_to_end(open.session, open.store, control) == RunEnd::stopped)
      throw Error(ExitCode::stopped, "the member was stopped; its run goes on from its checkpoint");
  }
  const AnalysedRun analysed =
      analysed_run(member->path, parse_analysis_settings({}), {.threads = 1, .quiet = true});
  write_text(series_path(member->path),
             series_csv(member_series(analysed.analysis, analysed.statics.mean_diameter)));
  write_text(numbers_path(member->path),
             numbers_csv(member_numbers(RunFile::open(member->path), analysed.analysis)));
}

void work(const EnsembleArguments& arguments) {
  WorkerOptions options{arguments.folder, arguments.times, {}, [](const std::string& member, int code) {
                          std::printf("%s %s\n", member.c_str(),
                                      code < 0    ? "begun"
                                      : code == 0 ? "done"
                                                  : fmt::format("ended with exit code {}", code).c_str());
                          std::fflush(stdout);
                        }};
  if (!arguments.max_wall.empty()) options.max_wall = parse_wall_time("--max-wall", arguments.max_wall);
  const WorkerEnd end = work_on_ensemble(options);
  std::printf("%zu done and %zu failed here; %zu are under way elsewhere%s\n", end.done, end.failed,
              end.elsewhere, end.enough ? "; the precision that was asked for is reached" : "");
}

void average(const EnsembleArguments& arguments) {
  const EnsembleView view = view_of_ensemble(arguments.folder);
  write_averages(view);
  std::printf("%s", ensemble_text(view).c_str());
}

void retry(const EnsembleArguments& arguments) {
  const EnsembleView view = view_of_ensemble(arguments.folder);
  std::size_t count = 0;
  for (std::size_t m = 0; m < view.states.size(); ++m) {
    if (view.states[m].stage != MemberStage::failed) continue;
    remove_file(failure_path(view.plan.members[m].path));
    ++count;
  }
  std::printf("%zu members wait again; talus ensemble work %s computes them\n", count,
              shell_quoted(arguments.folder).c_str());
}

/// `ensemble NAME FOLDER`.
CLI::App* add_folder_command(CLI::App& ensemble, const std::shared_ptr<EnsembleArguments>& arguments,
                             const std::string& name, const std::string& text) {
  CLI::App* command = ensemble.add_subcommand(name, text);
  command->add_option("folder", arguments->folder, "Folder of the ensemble")->required();
  return command;
}

void add_time_options(CLI::App& command, const std::shared_ptr<EnsembleArguments>& arguments) {
  command.add_option("--max-wall", arguments->max_wall,
                     "Stop with checkpoints before this much wall time has passed, HH:MM or HH:MM:SS");
  command
      .add_option(
          "--stale", arguments->times.stale,
          "Time without a heartbeat after which a worker of another machine is taken for dead, s; the "
          "same for all workers")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 86400.0));
}

void add_subcommands(CLI::App& command, const std::shared_ptr<EnsembleArguments>& arguments) {
  CLI::App* worker = add_folder_command(
      command, arguments, "work", "Compute members, one after the other, beside any number of other workers");
  add_time_options(*worker, arguments);
  worker->callback([arguments] { work(*arguments); });
  CLI::App* status =
      add_folder_command(command, arguments, "status", "How far it is, what failed, and the means");
  status->add_flag("--json", arguments->json, "Print it as JSON");
  status->callback([arguments] {
    const EnsembleView view = view_of_ensemble(arguments->folder);
    std::printf("%s", (arguments->json ? ensemble_json(view) + "\n" : ensemble_text(view)).c_str());
  });
  add_folder_command(command, arguments, "average",
                     "Write members.csv, averages.csv and ensemble.h5 of the members that are done")
      ->callback([arguments] { average(*arguments); });
  add_folder_command(command, arguments, "retry", "Let members that failed wait for a worker again")
      ->callback([arguments] { retry(*arguments); });
  CLI::App* member =
      add_folder_command(command, arguments, "member", "Compute one member, which a worker has claimed");
  member->add_option("name", arguments->member, "Its name, such as seed-7")->required();
  member->add_option("--max-wall", arguments->max_wall,
                     "Stop with a checkpoint before this much wall time has passed");
  member->group("");  // what a worker calls
  member->callback([arguments] { compute_member(*arguments); });
}

}  // namespace

void add_ensemble_command(CLI::App& app) {
  auto arguments = std::make_shared<EnsembleArguments>();
  CLI::App* command = app.add_subcommand(
      "ensemble", "Compute many beds of one scenario, on one machine or many; the same command goes on");
  command->add_option("scenario", arguments->scenario, "Scenario file (TOML; see docs/scenario.md)");
  command->add_option(
      "-o,--output", arguments->folder,
      "Folder of the ensemble; what is complete in it is kept, and seeds and values are added to it");
  command->add_option("--seeds", arguments->seeds, "Seeds, e.g. 1-50 or 1-3,8")->capture_default_str();
  command
      ->add_option("--vary", arguments->axes,
                   "Values of a key, e.g. contact.friction=0.3,0.5; with several of them each combination")
      ->allow_extra_args(false);
  command
      ->add_option("--set", arguments->settings,
                   "Change a key of the scenario in all members, e.g. --set bed.length=100")
      ->allow_extra_args(false);
  command->add_option(
      "--until", arguments->until,
      "Begin no more members once the standard error of a mean is this small, e.g. theta_c:0.2");
  command->add_option("--jobs", arguments->jobs, "Workers side by side, each on one thread")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  add_time_options(*command, arguments);
  add_subcommands(*command, arguments);
  command->require_subcommand(0, 1);
  command->callback([arguments, command] {
    if (command->get_subcommands().empty()) run_ensemble(*arguments);
  });
}

}  // namespace talus
