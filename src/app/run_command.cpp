/// `talus run`: computes a run from its scenario, or continues one.

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>
#include <thread>

#include "app/commands.h"
#include "app/progress.h"
#include "core/errors.h"
#include "core/hash.h"
#include "core/trigonometry.h"
#include "core/version.h"
#include "session/run.h"

namespace talus {
namespace {

struct RunArguments {
  std::string scenario;
  std::string output;
  std::vector<std::string> settings;
  std::uint64_t seed = 0;
  bool has_seed = false;
  int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  bool resume = false;
  bool overwrite = false;
  bool quiet = false;
};

volatile std::sig_atomic_t stop_requested = 0;

/// The first signal asks the run to stop after its step; the second leaves at once (the store is whole at any
/// time).
void handle_stop(int) {
  if (stop_requested != 0) _exit(static_cast<int>(ExitCode::stopped));
  stop_requested = 1;
}

void catch_stop_signals() {
  struct sigaction action = {};
  action.sa_handler = handle_stop;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

std::string host_name() {
  char name[256] = "unknown";
  gethostname(name, sizeof name - 1);
  return name;
}

std::string command_line(const RunArguments& arguments) {
  std::string line = "talus run " + arguments.scenario + " -o " + arguments.output;
  for (const std::string& setting : arguments.settings) line += " --set " + setting;
  return line;
}

RunHeader make_header(const RunArguments& arguments, const Session& session, const std::string& text) {
  RunHeader header;
  header.statics = run_statics(session.scenario(), session.world());
  header.scenario_given = text;
  header.scenario_resolved = resolved_toml(session.scenario());
  header.seed = session.scenario().seed;
  header.provenance = {{"version", version},
                       {"git_hash", git_hash},
                       {"compiler", compiler},
                       {"flags", build_flags},
                       {"host", host_name()},
                       {"threads", std::to_string(arguments.threads)},
                       {"start", utc_now()},
                       {"command", command_line(arguments)},
                       {"scenario_file", arguments.scenario}};
  return header;
}

struct OpenRun {
  RunStore store;
  Session session;
};

OpenRun start_run(const RunArguments& arguments) {
  std::vector<std::string> settings = arguments.settings;
  if (arguments.has_seed) settings.push_back("seed=" + std::to_string(arguments.seed));
  std::string text;
  const Scenario scenario = read_scenario(arguments.scenario, settings, &text);
  Session session(scenario);
  RunStore store =
      RunStore::create(arguments.output, make_header(arguments, session, text), arguments.overwrite);
  return {std::move(store), std::move(session)};
}

/// The scenario of a resumed run is the one stored with it; a file that says something else is refused.
OpenRun resume_run(const RunArguments& arguments) {
  RunHeader header;
  Checkpoint checkpoint;
  RunStore store = RunStore::resume(arguments.output, header, checkpoint);
  std::vector<std::string> settings = arguments.settings;
  if (arguments.has_seed) settings.push_back("seed=" + std::to_string(arguments.seed));
  if (!arguments.scenario.empty() &&
      resolved_toml(read_scenario(arguments.scenario, settings)) != header.scenario_resolved)
    throw Error(ExitCode::bad_data,
                arguments.output + " was started with another scenario than " + arguments.scenario +
                    "; compare `talus info` of the run with `talus check` of the scenario");
  const Scenario scenario = parse_scenario(header.scenario_resolved, arguments.output + ":/parameters");
  return {std::move(store), Session(scenario, std::move(checkpoint))};
}

void print_end(const RunArguments& arguments, const Session& session) {
  const SolverRecord& record = session.solver_record();
  if (record.unconverged_deposition + record.unconverged_tilt > 0)
    std::fprintf(
        stderr,
        "talus: warning: %lld steps of the deposition and %lld of the tilt did not reach their tolerance "
        "(largest residual at rest %.2g, while moving %.2g); one or two in a hundred are usual "
        "(docs/solver.md), solver.max_iterations gives them more passes\n",
        static_cast<long long>(record.unconverged_deposition),
        static_cast<long long>(record.unconverged_tilt), record.residual_max_rest,
        record.residual_max_moving);
  if (arguments.quiet) return;
  const std::optional<double> theta_c = session.angle_of_repose();
  if (theta_c)
    std::printf("The slope failed: angle of repose theta_c = %.3f deg.\n", degrees(*theta_c));
  else
    std::printf("The slope stands at %.3f deg.\n", degrees(session.world().tilt));
  std::printf("%s: %lld steps, state hash %s\n", arguments.output.c_str(),
              static_cast<long long>(session.world().step), hash_text(state_hash(session.world())).c_str());
}

void run(const RunArguments& arguments) {
  const RunPresence presence = run_presence(arguments.output);
  if (arguments.resume && presence == RunPresence::packed) {
    if (!arguments.quiet) std::printf("%s is complete already.\n", arguments.output.c_str());
    return;
  }
  catch_stop_signals();
  OpenRun open =
      arguments.resume && presence == RunPresence::folder ? resume_run(arguments) : start_run(arguments);
  open.session.use_threads(arguments.threads);
  ProgressLine line(arguments.quiet);
  RunControl control;
  control.stop = &stop_requested;
  control.on_step = [&line](const RunProgress& progress) { line.show(progress); };
  const RunEnd end = run_to_end(open.session, open.store, control);
  line.finish();
  if (end == RunEnd::stopped)
    throw Error(ExitCode::stopped, "stopped at " + std::to_string(degrees(open.session.world().tilt)) +
                                       " deg; continue with: talus run " + arguments.scenario + " -o " +
                                       arguments.output + " --resume");
  print_end(arguments, open.session);
}

}  // namespace

void add_run_command(CLI::App& app) {
  auto arguments = std::make_shared<RunArguments>();
  CLI::App* command = app.add_subcommand("run", "Compute a run: deposition, rest, tilt to failure");
  command->add_option("scenario", arguments->scenario, "Scenario file (TOML; see docs/scenario.md)")
      ->required();
  command->add_option("-o,--output", arguments->output,
                      "Run file to write (HDF5) [name of the scenario + .h5]");
  command
      ->add_option("--set", arguments->settings,
                   "Change a key of the scenario, e.g. --set contact.friction=0.3")
      ->allow_extra_args(false);
  CLI::Option* seed = command->add_option("--seed", arguments->seed, "Seed of the random deposition");
  command
      ->add_option("--threads", arguments->threads, "Threads of the solver; the result does not depend on it")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  CLI::Option* resume = command->add_flag("--resume", arguments->resume,
                                          "Continue from the last checkpoint, or start where there is none");
  command->add_flag("--overwrite", arguments->overwrite, "Replace a run of this name")->excludes(resume);
  command->add_flag("-q,--quiet", arguments->quiet, "Print errors and warnings only");
  command->callback([arguments, seed] {
    arguments->has_seed = seed->count() > 0;
    if (arguments->output.empty())
      arguments->output = std::filesystem::path(arguments->scenario).stem().string() + ".h5";
    run(*arguments);
  });
}

}  // namespace talus
