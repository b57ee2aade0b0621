/// `talus ensemble`: computes many beds of one scenario, by any number of processes that share a folder.

#include <algorithm>
#include <cstdio>
#include <fmt/core.h>
#include <functional>
#include <memory>

#include "app/command_line.h"
#include "app/commands.h"
#include "app/ensemble_report.h"
#include "app/ensemble_submit.h"
#include "app/ensemble_workers.h"
#include "app/open_run.h"
#include "app/options.h"
#include "app/program_end.h"
#include "app/progress.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/hash.h"
#include "base/text.h"
#include "ensemble/member_results.h"
#include "ensemble/member_task.h"
#include "ensemble/worker.h"
#include "io/durable_file.h"
#include "io/run_file.h"
#include "runs/analysis_run.h"

namespace talus::app {
namespace {

struct EnsembleArguments : EnsembleWorkers {
  std::string scenario;
  std::string member;
  std::string seeds = "1-4";
  std::vector<std::string> axes;
  std::vector<std::string> settings;
  std::string until;
  std::string keep;
  bool json = false;
};

void run_ensemble(const EnsembleArguments& arguments) {
  if (arguments.scenario.empty() || arguments.folder.empty())
    throw Error(ExitCode::usage,
                "expected a scenario and a folder: talus ensemble SCENARIO --seeds 1-50 -o FOLDER");
  if (!arguments.until.empty()) ensemble::parse_precision(arguments.until);
  ensemble::check_keep(arguments.keep);
  const ensemble::EnsembleManifest wanted{
      "",
      ensemble::parse_seeds(arguments.seeds),
      arguments.until,
      ensemble::plan_variants(arguments.scenario, arguments.settings, arguments.axes),
      ensemble::PlainTask{},
      arguments.keep};
  if (const std::uint64_t seed = wanted.seeds.front(); wanted.seeds.size() == 1 && seed > 1)
    print_error("talus: note: one seed, number {0}; --seeds 1-{0} are {0} seeds\n", seed);
  const EnsembleView view = compute_ensemble(wanted, arguments, {arguments.scenario});
  print_text(arguments.json ? ensemble_json(view) + "\n" : ensemble_text(view));
  refuse_failures(view.plan, "left out of the means");
}

/// Packs the run of a member with its analysis after the additional work of its task; a packed member is
/// done. Throws Error(stopped) if `should_continue` returns false; computed data stay in the folder.
bool pack_member(const ensemble::Member& member, const ensemble::EnsembleManifest& manifest,
                 const std::string& folder, io::RunStore& store,
                 const std::function<bool()>& should_continue) {
  const auto progress = [&](std::size_t) {
    if (!should_continue())
      throw Error(ExitCode::stopped, "the member was stopped; its analysis will be repeated");
  };
  io::PackedParts parts;
  const io::RunFile run = io::RunFile::open(member.path);
  const analysis::Analysis analysis = runs::analyse_run(run, analysis::AnalysisParameters(), 1, progress);
  parts.analysis = &analysis;
  if (std::holds_alternative<ensemble::ReadingsTask>(manifest.task))
    parts.readings = ensemble::make_readings(member, run, progress);
  parts.frames = ensemble::keeps_frames(manifest, member.seed) || !ensemble::is_in_folder(member, folder);
  return store.pack(should_continue, parts);
}

/// Runs or resumes a member, does the work of its task, and packs it with its analysis.
void compute_member(const EnsembleArguments& arguments) {
  const ensemble::EnsembleManifest manifest = ensemble::read_ensemble(arguments.folder);
  const ensemble::EnsemblePlan plan = ensemble::plan_of(manifest, arguments.folder);
  const auto member = std::ranges::find(plan.members, arguments.member, &ensemble::Member::name);
  if (member == plan.members.end())
    throw Error(ExitCode::usage, "{} has no member {}", arguments.folder, arguments.member);
  if (const std::string damage = io::set_damaged_aside(member->path); !damage.empty())
    print_error("talus: note: {}; the member is restarted\n", damage);
  if (ensemble::is_complete(*member)) return;  // another worker was faster
  session::RunControl control;
  control.stop = stop_request();
  control.on_step = run_shown(false);
  control.pack = [&](io::RunStore& store, const std::function<bool()>& should_continue) {
    return pack_member(*member, manifest, arguments.folder, store, should_continue);
  };
  if (!arguments.max_wall.empty()) control.max_wall = parse_wall_time("--max-wall", arguments.max_wall);
  RunRequest request;
  request.scenario = plan.variants[member->variant].scenario_file;
  request.output = member->path;
  request.command_line = command_line();
  request.bed = member->origin.bed;
  request.settings.push_back(fmt::format("seed={}", member->seed));
  const auto* trials = std::get_if<ensemble::TrialsTask>(&manifest.task);
  if (trials != nullptr) request.facts = {{trials_fact, ensemble::plan_text(*trials)}};
  OpenRun open =
      io::run_presence(member->path) == io::RunPresence::folder ? resume_run(request) : start_run(request);
  if (trials != nullptr) control.trials = member_trials(*trials, member->path);
  open.session.use_threads(1);
  const CommitOnSignals commit;
  if (session::run_to_end(open.session, open.store, control) == session::RunEnd::stopped)
    throw Error(ExitCode::stopped, "the member was stopped; its run continues from its checkpoint");
  print("{} is done: state {}\n", member->name, hash_text(state_hash(open.session.world())));
}

void work(const EnsembleArguments& arguments) {
  ensemble::WorkerOptions options{
      arguments.folder, arguments.times, {}, [](const std::string& member, int code) {
        print("{} {}\n", member,
              code < 0    ? "begun"
              : code == 0 ? "done"
                          : fmt::format("ended with exit code {}", code));
        std::fflush(stdout);
      }};
  options.on_wait = on_wait;
  if (!arguments.max_wall.empty()) options.max_wall = parse_wall_time("--max-wall", arguments.max_wall);
  const ensemble::EnsemblePlan plan =
      ensemble::plan_of(ensemble::read_ensemble(arguments.folder), arguments.folder);
  ensemble::drop_leftovers(plan);
  const ensemble::WorkerEnd end = ensemble::work_on_ensemble(options);
  ensemble::drop_leftovers(plan);
  print("{} done and {} failed here; {} are under way elsewhere{}\n", end.done, end.failed, end.elsewhere,
        end.enough ? "; the requested precision is reached" : "");
}

void average(const EnsembleArguments& arguments) {
  ensemble::KnownMembers known;
  const EnsembleView view = write_averages(arguments.folder, known);
  print_text(ensemble_text(view));
  for (const ensemble::MemberState& state : view.states)
    if (!state.damage.empty()) throw Error(ExitCode::bad_data, state.damage);
}

void retry(const EnsembleArguments& arguments) {
  ensemble::KnownMembers known;
  const ensemble::EnsemblePlan plan =
      ensemble::plan_of(ensemble::read_ensemble(arguments.folder), arguments.folder);
  std::size_t count = restart_damaged_members(plan, known);
  const std::vector<ensemble::MemberState> states = ensemble::scan_members(plan);
  for (std::size_t m = 0; m < states.size(); ++m) {
    if (states[m].stage != ensemble::MemberStage::failed) continue;
    io::remove_file(ensemble::failure_path(plan.members[m].path));
    ++count;
  }
  print("{} again; talus ensemble work {} computes {}\n",
        count == 1 ? "1 member is waiting" : fmt::format("{} members are waiting", count),
        shell_quoted(arguments.folder), count == 1 ? "it" : "them");
}

/// Adds the subcommand `ensemble NAME FOLDER`.
CLI::App* add_folder_command(CLI::App& ensemble, const std::shared_ptr<EnsembleArguments>& arguments,
                             const std::string& name, const std::string& text) {
  CLI::App* command = ensemble.add_subcommand(name, text);
  command->add_option("FOLDER", arguments->folder, "Folder of the ensemble")->required();
  return command;
}

void add_time_options(CLI::App& command, const std::shared_ptr<EnsembleArguments>& arguments) {
  add_option(command, "--max-wall", arguments->max_wall, "HH:MM[:SS]",
             "Stop with checkpoints before this wall time is over");
  add_option(command, "--stale", arguments->times.stale, "S",
             "Seconds without a heartbeat after which a worker on another machine is considered dead; must "
             "be the same for all workers")
      ->capture_default_str()
      ->check(in_range(1.0, 86400.0));
}

void add_subcommands(CLI::App& command, const std::shared_ptr<EnsembleArguments>& arguments) {
  CLI::App* worker = add_folder_command(
      command, arguments, "work", "Compute members one after another, alongside any number of other workers");
  add_time_options(*worker, arguments);
  worker->callback([arguments] { work(*arguments); });
  CLI::App* status =
      add_folder_command(command, arguments, "status", "Show progress, failed members, and means");
  status->add_flag("--json", arguments->json, "Print JSON");
  status->callback([arguments] {
    ensemble::KnownMembers known;
    const EnsembleView view = view_of_ensemble(arguments->folder, known);
    const EnsembleJobs jobs = jobs_of_ensemble(arguments->folder);
    print_text(arguments->json ? ensemble_json(view, jobs) + "\n" : ensemble_text(view, jobs));
  });
  add_folder_command(command, arguments, "average",
                     "Write members.csv, averages.csv and ensemble.h5 of the members that are done")
      ->callback([arguments] { average(*arguments); });
  add_folder_command(command, arguments, "retry", "Queue failed members for computation again")
      ->callback([arguments] { retry(*arguments); });
  CLI::App* member =
      add_folder_command(command, arguments, "member", "Compute one member, which a worker has claimed");
  member->add_option("name", arguments->member, "Its name, such as seed-7")->required();
  add_option(*member, "--max-wall", arguments->max_wall, "HH:MM[:SS]",
             "Stop with a checkpoint before this wall time is over");
  member->group("");  // internal: called by workers
  member->callback([arguments] { compute_member(*arguments); });
}

}  // namespace

void add_ensemble_command(CLI::App& app) {
  auto arguments = std::make_shared<EnsembleArguments>();
  CLI::App* command = app.add_subcommand(
      "ensemble",
      "Compute many beds of one scenario, on one machine or several; repeat the command to continue");
  command->add_option("SCENARIO", arguments->scenario, "Scenario file (TOML; see docs/scenario.md)");
  add_option(*command, "-o,--output", arguments->folder, "FOLDER",
             "Folder of the ensemble; complete members are kept, and new seeds and values are added");
  add_option(*command, "--seeds", arguments->seeds, "SEEDS", "Seeds, e.g. 1-50 or 1-3,8")
      ->capture_default_str();
  add_option(
      *command, "--vary", arguments->axes, "KEY=VALUE,...",
      "Values of a key, e.g. contact.friction=0.3,0.5 or the range 0.2:0.6:0.1; if given several times, all "
      "combinations are computed")
      ->allow_extra_args(false);
  add_scenario_settings(*command, arguments->settings, " in all members");
  add_option(*command, "--until", arguments->until, "MEAN:ERROR",
             "Start no new members once the standard error of a mean is this small, e.g. theta_c:0.2");
  add_jobs_option(*command, arguments->jobs);
  add_option(*command, "--keep", arguments->keep, "all|analysis|N",
             "Data kept of a finished member: all (default), analysis (everything except the frames), or N "
             "(analysis, plus the frames of the N lowest seeds)");
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  add_time_options(*command, arguments);
  add_subcommands(*command, arguments);
  add_submit_commands(*command);
  command->require_subcommand(0, 1);
  command->callback([arguments, command] {
    if (command->get_subcommands().empty()) run_ensemble(*arguments);
  });
}

}  // namespace talus::app
