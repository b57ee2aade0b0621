/// `talus perturb`: how strong a push starts an avalanche, at tilts on the way to failure.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fmt/core.h>
#include <memory>
#include <optional>

#include "app/command_line.h"
#include "app/commands.h"
#include "app/figure_files.h"
#include "app/figure_runs.h"
#include "app/figure_text.h"
#include "app/gnuplot.h"
#include "app/jobs_option.h"
#include "app/open_run.h"
#include "app/pool_line.h"
#include "app/progress.h"
#include "app/stop_signals.h"
#include "core/errors.h"
#include "core/output_file.h"
#include "core/trigonometry.h"
#include "core/visible_text.h"
#include "figures/perturbation_figure.h"
#include "io/durable_file.h"
#include "io/run_file.h"
#include "scenario/text.h"
#include "session/analysis_parameters.h"
#include "session/perturbation_threshold.h"

namespace talus {
namespace {

struct PerturbArguments {
  std::string scenario;
  std::string folder;
  std::vector<std::string> settings;
  std::string seeds = "1-4";
  std::optional<std::uint64_t> seed;
  PerturbationPlan plan;
  std::string patch = "10x2";
  int jobs = default_jobs();
};

/// The command of one seed, as a user would type it, from the subcommand on.
std::vector<std::string> words_of(const PerturbArguments& arguments, std::uint64_t seed) {
  std::vector<std::string> words = {"perturb", path_word(arguments.scenario),
                                    "-o",      path_word(arguments.folder),
                                    "--seed",  std::to_string(seed),
                                    "--from",  short_text(arguments.plan.first),
                                    "--every", short_text(arguments.plan.every),
                                    "--patch", patch_text(arguments.plan.patch)};
  add_settings(words, arguments.settings);
  return words;
}

/// One variant without a name: its runs are in the folder itself.
EnsemblePlan plan_runs(const PerturbArguments& arguments) {
  const std::vector<std::uint64_t> seeds =
      arguments.seed ? std::vector{*arguments.seed} : parse_seeds(arguments.seeds);
  std::vector<std::string> with_seed = arguments.settings;
  with_seed.push_back(fmt::format("seed={}", seeds.front()));
  const Scenario scenario = read_scenario(arguments.scenario, with_seed);
  return plan_ensemble(seeds, {{"", arguments.scenario, scenario}}, arguments.folder);
}

/// The table stands beside the run.
std::string table_path(const std::string& run) { return file_beside(run, ".csv"); }

void write_table(const std::string& run, const PerturbationTable& table) {
  write_text(table_path(run), perturbation_csv(table));
}

/// The tilt of a session in deg, to the step.
double tilt_of(const Session& session) {
  const double step = session.scenario().tilt.step;
  return static_cast<double>(std::llround(degrees(session.world().tilt) / step)) * step;
}

/// Whether the session stands at a tilt of the plan, on its way to failure.
bool is_due(const Session& session, const PerturbationPlan& plan) {
  if (session.phase() != Phase::tilt || session.angle_of_repose()) return false;
  const auto steps = [&](double angle) { return std::llround(angle / session.scenario().tilt.step); };
  const auto since_first = steps(tilt_of(session)) - steps(plan.first);
  return since_first >= 0 && since_first % std::max(1LL, steps(plan.every)) == 0;
}

/// "[0.32, 0.37] sqrt(g D)": between what started no avalanche and what did.
std::string bracket_text(const Threshold& threshold) {
  if (!threshold.held) return "does not hold by itself";
  if (std::isinf(threshold.with))
    return fmt::format("no avalanche up to {:.3g} sqrt(g D)", threshold.without);
  return fmt::format("threshold in [{:.3g}, {:.3g}] sqrt(g D){}", threshold.without, threshold.with,
                     threshold.monotone ? "" : ", erratic");
}

/// Steps the run to its end, with the trials of each state that is not in the table yet.
void carry_through(OpenRun& open, PerturbationTable& table, const std::string& output) {
  const CommitOnSignals commit;
  const volatile std::sig_atomic_t* stop = stop_request();
  const auto keep_on = [stop] {
    if (*stop != 0)
      throw Error(ExitCode::stopped, "the perturbation was stopped; repeat the command to continue");
  };
  ProgressLine line(false);
  RunControl control;
  control.stop = stop;
  control.on_step = [&](const RunProgress& progress) {
    line.show(progress);
    const Session& session = progress.session;
    const double tilt = tilt_of(session);
    const bool done = !table.states.empty() && table.states.back().tilt >= tilt;
    if (done || !is_due(session, table.plan)) return;
    table.states.push_back({tilt, perturb(session.world(), session.scenario(), table.plan.patch, keep_on)});
    write_table(output, table);
    line.finish();
    std::fprintf(stderr, "%.3f deg: %s\n", tilt,
                 bracket_text(threshold_of(table.states.back().trials)).c_str());
  };
  const RunEnd end = run_to_end(open.session, open.store, control);
  line.finish();
  if (end == RunEnd::stopped) keep_on();
}

/// Throws as read_text and parse_perturbation_csv do.
PerturbationTable read_table(const Member& member, const PerturbationPlan& plan) {
  const std::string path = table_path(member.path);
  return parse_perturbation_csv(read_text(path), path, plan);
}

/// Whether run and table are there and complete. Throws Error(bad_data) where what is there is that of
/// another scenario or plan, or the table of a run is missing.
bool is_perturbed(const Member& member, const PerturbationPlan& plan) {
  is_complete(member, "perturbation");  // refuses that of another scenario
  if (run_presence(member.path) == RunPresence::none) return false;
  if (!std::filesystem::exists(table_path(member.path)))
    throw Error(ExitCode::bad_data,
                fmt::format("{} has no table beside it, expected {}; give another folder, or remove the run",
                            member.path, table_path(member.path)));
  return read_table(member, plan).complete;
}

/// Computes the run of a member and its table, or goes on with them, and says on stderr what was found at
/// each state. The table is written after each state, before the run commits what comes after it, so that
/// neither is ever ahead of what it needs. Throws Error(stopped) on SIGINT, SIGTERM and SIGHUP, and as
/// start_run and resume_run do.
void perturb_seed(const PerturbArguments& arguments, const Member& member) {
  prepare_folder(arguments.folder);
  if (is_perturbed(member, arguments.plan)) return;
  RunRequest request{arguments.scenario, member.path, arguments.settings, 1, false, "talus"};
  request.settings.push_back(fmt::format("seed={}", member.seed));
  for (const std::string& word : words_of(arguments, member.seed)) request.command_line += " " + word;
  const RunPresence presence = run_presence(member.path);
  PerturbationTable table{arguments.plan, false, {}};
  if (presence == RunPresence::none)
    write_table(member.path, table);
  else
    table = read_table(member, arguments.plan);
  if (presence != RunPresence::packed) {
    OpenRun open = presence == RunPresence::folder ? resume_run(request) : start_run(request);
    open.session.use_threads(request.threads);
    carry_through(open, table, member.path);
  }
  table.complete = true;
  write_table(member.path, table);
}

/// Computes the seeds that are not complete, each in a process of its own, and returns those that ended with
/// an error. Throws Error(stopped), and as is_perturbed does.
std::vector<FailedJob> compute_seeds(const PerturbArguments& arguments, const EnsemblePlan& plan) {
  std::vector<Job> jobs;
  for (const Member& member : plan.members)
    if (!is_perturbed(member, arguments.plan))
      jobs.push_back(job_of(member, words_of(arguments, member.seed)));
  return run_with_progress(jobs, plan.members.size(), arguments.jobs, "perturbation");
}

/// Reports the seeds that are complete. The tables are written in any case, the figure where there is a
/// gnuplot.
void report(const PerturbArguments& arguments, const EnsemblePlan& plan) {
  std::vector<std::string> paths;
  std::vector<PerturbationTable> tables;
  for (const Member& member : plan.members) {
    if (!is_perturbed(member, arguments.plan)) continue;
    paths.push_back(member.path);
    tables.push_back(read_table(member, arguments.plan));
  }
  const std::vector<RunGroup> groups = group_runs(open_figure_runs(paths, parse_analysis_settings({}), {}));
  const std::filesystem::path folder = arguments.folder;
  const Figure figure = perturbation_figure(groups.front(), tables);
  const std::string text = perturbation_markdown(groups.front(), tables);
  write_text(folder / file_of(figure, figure.tables.front()), csv_text(figure.tables.front()));
  write_text(folder / "perturb.md", text);
  std::printf("%s", text.c_str());
  try {
    require_gnuplot();
    write_figure(figure, groups, arguments.folder, {.columns = 0, .command_line = command_line()});
  } catch (const Error& error) {
    if (error.code() != ExitCode::unavailable) throw;
    std::fprintf(stderr, "talus: warning: the figure is left out: %s\n", error.what());
  }
}

void run_perturb(PerturbArguments& arguments) {
  const std::optional<SurfacePatch> patch = parse_patch(arguments.patch);
  if (!patch)
    throw Error(ExitCode::usage,
                fmt::format("--patch {}: expected width and depth in mean diameters, such as 10x2",
                            visible_word(arguments.patch)));
  arguments.plan.patch = *patch;
  const EnsemblePlan plan = plan_runs(arguments);
  output_target((std::filesystem::path(arguments.folder) / "perturb.md").string(),
                {true, {arguments.scenario}});
  if (arguments.seed) return perturb_seed(arguments, plan.members.front());
  const std::vector<FailedJob> failed = compute_seeds(arguments, plan);
  if (failed.size() < plan.members.size()) report(arguments, plan);
  if (!failed.empty()) refuse(failed);
}

}  // namespace

void add_perturb_command(CLI::App& app) {
  auto arguments = std::make_shared<PerturbArguments>();
  CLI::App* command = app.add_subcommand(
      "perturb",
      "Push on the surface at tilts up to failure, and find the weakest push that starts an avalanche");
  command->add_option("scenario", arguments->scenario, "Scenario file (TOML; see docs/scenario.md)")
      ->required();
  command
      ->add_option("-o,--output", arguments->folder,
                   "Folder of runs and tables; what is complete in it is kept")
      ->required();
  CLI::Option* seeds =
      command->add_option("--seeds", arguments->seeds, "Seeds, e.g. 1-4 or 1-3,8")->capture_default_str();
  command
      ->add_option("--seed", arguments->seed,
                   "Compute only this seed, in this process, and write no summary; for job arrays")
      ->excludes(seeds);
  command->add_option("--from", arguments->plan.first, "First tilt at which copies are pushed, deg")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 60.0));
  command->add_option("--every", arguments->plan.every, "Tilt between these states, deg")
      ->capture_default_str()
      ->check(CLI::Range(1e-3, 60.0));
  command
      ->add_option("--patch", arguments->patch,
                   "Width and depth of the part of the surface that is pushed, D")
      ->capture_default_str();
  command
      ->add_option("--set", arguments->settings,
                   "Change a key of the scenario, e.g. --set deposition.friction=0.15")
      ->allow_extra_args(false);
  command->add_option("--jobs", arguments->jobs, "Seeds side by side, each on one thread")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  command->callback([arguments] { run_perturb(*arguments); });
}

}  // namespace talus
