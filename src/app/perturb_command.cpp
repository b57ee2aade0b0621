/// `talus perturb`: finds how strong a push starts an avalanche, at tilts before failure.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "app/command_line.h"
#include "app/commands.h"
#include "app/ensemble_workers.h"
#include "app/options.h"
#include "app/other_programs.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/hash.h"
#include "base/output_file.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "ensemble/worker.h"
#include "session/run_header.h"

namespace talus::app {
namespace {

struct PerturbArguments : EnsembleWorkers {
  std::string scenario;
  std::vector<std::string> settings;
  std::string seeds = "1-4";
  std::optional<std::uint64_t> seed;
  ensemble::TrialsTask plan;
  std::string patch = "10x2";
};

/// Adds one seed to the ensemble and computes only that seed. Waits if another process computes it.
void perturb_seed(const PerturbArguments& arguments, const ensemble::EnsembleManifest& wanted) {
  ensemble::KnownMembers known;
  begin_ensemble(arguments.folder, wanted, {arguments.scenario}, known);
  const ensemble::EnsemblePlan plan = ensemble::plan_of(wanted, arguments.folder);
  ensemble::WorkerOptions options{arguments.folder, {}, {}, {}, plan.members.front().name, on_wait};
  while (ensemble::work_on_ensemble(options).elsewhere > 0)
    std::this_thread::sleep_for(std::chrono::seconds(1));
  refuse_failures(plan, "its trials are not complete");
  const std::string& run = plan.members.front().path;
  require_trials(io::RunFile::open(run), arguments.plan, run);  // an existing run may lack them
}

/// Reports the finished seeds: tables, and the figure if matplotlib is installed.
void report(const PerturbArguments& arguments, const ensemble::EnsemblePlan& plan) {
  std::vector<std::string> words = {"report", arguments.folder, ensemble::patch_text(arguments.plan.patch),
                                    fmt::format("{:g}", arguments.plan.first), command_line()};
  for (const std::size_t m : ensemble::done_members(plan)) {
    const std::string& run = plan.members[m].path;
    require_trials(io::RunFile::open(run), arguments.plan, run);
    words.push_back(run);
  }
  print_text(output_of_python_module("perturb", words));
}

void run_perturb(PerturbArguments& arguments) {
  const std::optional<ensemble::SurfacePatch> patch = ensemble::parse_patch(arguments.patch);
  if (!patch)
    throw Error(ExitCode::usage, "--patch {}: expected width and depth in mean diameters, e.g. 10x2",
                visible_word(arguments.patch));
  arguments.plan.patch = *patch;
  const ensemble::EnsembleManifest wanted{
      // with one unnamed variant, whose runs are in the folder itself
      .seeds = ensemble::parse_seeds(arguments.seed ? std::to_string(*arguments.seed) : arguments.seeds),
      .variants = ensemble::plan_variants(arguments.scenario, arguments.settings, {}),
      .task = arguments.plan};
  output_target((std::filesystem::path(arguments.folder) / "perturb.md").string(),
                {true, {arguments.scenario}});
  output_of_python_module("perturb", {"check"});  // before long work
  if (arguments.seed) return perturb_seed(arguments, wanted);
  const EnsembleView view = compute_ensemble(wanted, arguments, {arguments.scenario});
  const ensemble::EnsemblePlan plan = ensemble::plan_of(wanted, arguments.folder);
  if (ensemble::done_members(plan).empty()) {
    refuse_failures(plan, "nothing can be reported");
    print_text(ensemble_text(view));  // other workers compute it
    return;
  }
  report(arguments, plan);
  refuse_failures(plan, "left out of the tables");
}

}  // namespace

void add_perturb_command(CLI::App& app) {
  auto arguments = std::make_shared<PerturbArguments>();
  CLI::App* command = app.add_subcommand(
      "perturb",
      "Push the surface at tilts up to failure, and find the weakest push that starts an avalanche");
  command->add_option("SCENARIO", arguments->scenario, "Scenario file (TOML; see docs/scenario.md)")
      ->required();
  add_option(*command, "-o,--output", arguments->folder, "FOLDER",
             "Folder of runs and tables; complete members are kept")
      ->required();
  CLI::Option* seeds = add_option(*command, "--seeds", arguments->seeds, "SEEDS", "Seeds, e.g. 1-4 or 1-3,8")
                           ->capture_default_str();
  add_option(*command, "--seed", arguments->seed, "SEED",
             "Compute only this seed, without a summary; for job arrays")
      ->excludes(seeds);
  add_option(*command, "--from", arguments->plan.first, "DEG",
             "First tilt at which copies of the bed are pushed, deg")
      ->capture_default_str()
      ->check(in_range(0.0, ensemble::TrialsTask::highest));
  add_option(*command, "--every", arguments->plan.every, "DEG", "Interval of tilt between these states, deg")
      ->capture_default_str()
      ->check(in_range(ensemble::TrialsTask::min_every, ensemble::TrialsTask::highest));
  add_option(*command, "--patch", arguments->patch, "WIDTHxDEPTH",
             "Width and depth of the pushed part of the surface, in mean diameters")
      ->capture_default_str();
  add_scenario_settings(*command, arguments->settings);
  add_jobs_option(*command, arguments->jobs);
  command->callback([arguments] { run_perturb(*arguments); });
}

namespace {

/// Returns the tilt of a session in deg, rounded to the step.
double tilt_of(const session::Session& session) {
  const double step = session.scenario().tilt.step;
  return static_cast<double>(std::llround(degrees(session.world().tilt) / step)) * step;
}

/// Whether the session is at a tilt of the plan, before failure.
bool is_due(const session::Session& session, const ensemble::TrialsTask& plan) {
  if (session.phase() != session::Phase::tilt || session.angle_of_repose()) return false;
  const auto steps = [&](double angle) { return std::llround(angle / session.scenario().tilt.step); };
  const auto since_first = steps(tilt_of(session)) - steps(plan.first);
  return since_first >= 0 && since_first % std::max(1LL, steps(plan.every)) == 0;
}

/// A copy of the bed as a run that can be resumed, held at its tilt: neither commands, a guard nor a failure
/// ends it. Its file exists as long as the object.
class HeldBed {
 public:
  HeldBed(const session::Session& session, std::string path) : path_(std::move(path)) {
    session::Session held = session.copy();
    held.apply({0, CommandKind::tilt_rate, -1, 0.0});
    if (held.schedule().drag) held.apply({0, CommandKind::release});
    const io::Checkpoint state = held.checkpoint(0.0);
    scenario::Scenario scenario = session.scenario();
    scenario.commands.clear();
    scenario.guards.action = scenario::GuardAction::warn;
    scenario.tilt.program.clear();
    scenario.tilt.after_failure = scenario::AfterFailure::stop;
    scenario.tilt.end_angle = session::steepest_tilt;
    session::RunOrigin origin{scenario::resolved_toml(scenario), "", "", 1};
    origin.branch = io::BranchOrigin{"a program", 0, hash_text(state_hash(held.world())), state, ""};
    const io::RunHeader header = session::run_header(session::Session(scenario, state), origin);
    io::RunStore::create(path_, header, true).commit({}, state);
  }
  ~HeldBed() {
    std::error_code ignored;
    std::filesystem::remove_all(io::run_folder(path_), ignored);
  }
  HeldBed(const HeldBed&) = delete;
  HeldBed& operator=(const HeldBed&) = delete;

 private:
  std::string path_;
};

}  // namespace

void require_trials(const io::RunFile& run, const ensemble::TrialsTask& plan, const std::string& path) {
  const std::string found = find_value(run.header().provenance, trials_fact).value_or("none");
  if (found != ensemble::plan_text(plan))
    throw Error(ExitCode::bad_data,
                "{} has the trials '{}', expected '{}'; use another folder, or remove the run", path,
                visible_word(found, 120), ensemble::plan_text(plan));
}

std::function<std::vector<TrialRow>(const session::Session&)> member_trials(const ensemble::TrialsTask& plan,
                                                                            const std::string& path) {
  const io::RunFile run = io::RunFile::open(path);
  require_trials(run, plan, path);
  const std::vector<TrialRow> known = run.trials();
  double reached = known.empty() ? -1.0 : at(known.back(), TrialField::tilt);
  return [plan, reached, bed = path + ".trials.h5"](const session::Session& session) mutable {
    const double tilt = tilt_of(session);
    std::vector<TrialRow> rows;
    if (tilt <= reached || !is_due(session, plan)) return rows;  // a tilt may be held, or fall
    reached = tilt;
    const HeldBed held(session, bed);
    std::istringstream numbers =
        text_stream(output_of_python_module("perturb", {"trials", bed, ensemble::patch_text(plan.patch)}));
    std::string bracket;
    std::getline(numbers, bracket);
    print_error("{:.3f} deg: {}\n", tilt, bracket);
    TrialRow row{static_cast<double>(session.world().step), tilt};
    constexpr auto first = static_cast<std::size_t>(TrialField::velocity);
    for (std::size_t k = first; numbers >> row[k]; k = k + 1 < row.size() ? k + 1 : first)
      if (k + 1 == row.size()) rows.push_back(row);
    return rows;
  };
}

}  // namespace talus::app
