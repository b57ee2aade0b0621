/// `talus run`: computes a run from its scenario, or continues one.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fmt/core.h>
#include <memory>
#include <optional>
#include <thread>

#include "app/analysis_report.h"
#include "app/commands.h"
#include "app/map_options.h"
#include "app/open_run.h"
#include "app/options.h"
#include "app/program_end.h"
#include "app/progress.h"
#include "app/run_files.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/hash.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "io/run_store.h"
#include "pictures/live_maps.h"
#include "scenario/scripted_command.h"
#include "session/run_header.h"

namespace talus::app {
namespace {

/// The request without its seed and command line; an empty scenario stands for that of the run.
struct RunArguments : RunRequest {
  std::string seed;      ///< empty: seed of the scenario
  std::string max_wall;  ///< HH:MM; empty: no limit
  bool resume = false;
  bool quiet = false;
  std::string frames;  ///< folder of maps drawn during the run; empty: none
  MapArguments maps;

  RunArguments() { threads = processor_count(); }
};

std::string command_line_of(const RunArguments& arguments) {
  std::string line = "talus run";
  if (!arguments.scenario.empty()) line += " " + shell_quoted(arguments.scenario);
  if (!arguments.branch.empty())
    line += fmt::format(" --branch {} --at {}", shell_quoted(arguments.branch), shell_quoted(arguments.at));
  line += " -o " + shell_quoted(arguments.output);
  for (const std::string& setting : arguments.settings) line += " --set " + shell_quoted(setting);
  return line;
}

/// Resolves the first argument: a scenario or, with --resume and without -o, the file or folder of a run.
void settle_names(RunArguments& arguments) {
  if (arguments.scenario.empty() && arguments.branch.empty()) throw CLI::RequiredError("SCENARIO");
  if (!arguments.branch.empty() && !arguments.seed.empty())
    throw Error(ExitCode::usage, "a branch has the bed of its parent run: omit --seed");
  if (arguments.scenario.empty()) {
    if (arguments.output.empty())
      throw Error(ExitCode::usage, "name the branch of {} with -o", arguments.branch);
    return;
  }
  const bool names_run =
      arguments.resume && arguments.output.empty() && !arguments.scenario.ends_with(".toml");
  if (!names_run) {
    io::refuse_no_scenario(arguments.scenario);
    if (arguments.output.empty())
      arguments.output = std::filesystem::path(arguments.scenario).stem().string() + ".h5";
    return;
  }
  if (!arguments.settings.empty() || !arguments.seed.empty())
    throw Error(ExitCode::usage, "a run is resumed with its own scenario: omit --set and --seed");
  std::string& run = arguments.output;
  run = std::move(arguments.scenario);
  arguments.scenario.clear();
  while (run.ends_with('/')) run.pop_back();
  if (run.ends_with(io::run_folder(""))) run.resize(run.size() - io::run_folder("").size());
  if (io::run_presence(run) == io::RunPresence::none)
    throw Error(ExitCode::missing_input,
                "{}: no run to resume; expected a run file, or its folder {} with a first commit; start it "
                "with: talus run SCENARIO -o {}",
                run, io::run_folder(run), run);
}

/// Moves the settings of maps from those of the scenario, which have other names. They need --pictures.
void take_map_settings(RunArguments& arguments) {
  std::erase_if(arguments.settings, [&arguments](const std::string& setting) {
    if (!is_map_setting(setting)) return false;
    if (arguments.frames.empty())
      throw Error(ExitCode::usage, "--set {}: a parameter of maps requires --pictures",
                  visible_word(setting));
    arguments.maps.settings.push_back(setting);
    return true;
  });
}

/// Returns the request, with the seed among its settings.
RunRequest request_of(const RunArguments& arguments) {
  RunRequest request = arguments;
  if (!arguments.seed.empty()) request.settings.push_back(fmt::format("seed={}", arguments.seed));
  request.command_line = command_line_of(arguments);
  return request;
}

void print_rest(const session::Session& session) {
  const std::string tilt = degrees_text(session.world().tilt, 3);
  if (const std::optional<double> theta_r = session.angle_at_rest())
    print("Its flow stopped at a tilt of {} deg: angle at rest theta_r = {:.3f} deg.\n", tilt,
          degrees(*theta_r));
  else
    print("Its flow had not stopped when the run ended, at a tilt of {} deg: no angle at rest.\n", tilt);
}

/// Warns of commands of the scenario that a complete run did not reach.
void warn_of_waiting_commands(const session::Session& session) {
  const scenario::Scenario& scenario = session.scenario();
  for (const std::size_t k : session::waiting_commands(scenario, session.schedule()))
    print_error("talus: warning: {} ({}, {}) was not carried out: the run ended earlier, at {} deg\n",
                scenario::command_section(k),
                session::command_text(scenario::command_of(scenario.commands[k])),
                scenario::moment_text(scenario.commands[k]), degrees_text(session.world().tilt, 3));
}

void print_end(const RunArguments& arguments, const session::Session& session) {
  warn_of_waiting_commands(session);
  const StepRemark remark = remark_on(session.schedule().record, session.world().step);
  if (!remark.usual) print_error("talus: warning: {}\n", remark.text);
  for (std::size_t k = 0; k < session::guard_count; ++k)
    if (const std::int64_t steps = session.schedule().warnings.steps[k]; steps > 0)
      print_error("talus: warning: guards.{} was exceeded in {} steps, first in step {}\n",
                  session::guard_names[k], steps, session.schedule().warnings.first[k]);
  if (arguments.quiet) return;
  const std::optional<double> theta_c = session.angle_of_repose();
  const scenario::AfterFailure after = session.scenario().tilt.after_failure;
  if (theta_c)
    print("The slope failed: angle of repose theta_c = {:.3f} deg{}.\n", degrees(*theta_c),
          after == scenario::AfterFailure::lower ? "" : beyond_repose(*theta_c, session.world().tilt));
  else
    print("The slope is stable at {} deg.\n", degrees_text(session.world().tilt, 3));
  if (theta_c && after != scenario::AfterFailure::stop) print_rest(session);
  if (remark.usual && !remark.text.empty()) print("{}\n", remark.text);
  print("{}: {} steps, state hash {}\n", arguments.output, session.world().step,
        hash_text(state_hash(session.world())));
}

/// Returns the maps drawn during the run, if any. Throws on invalid options before the run is touched.
std::optional<pictures::LiveMaps> prepare_maps(const RunArguments& arguments, const RunRequest& request,
                                               bool resumed) {
  if (arguments.frames.empty()) return std::nullopt;
  const pictures::MapOptions options = map_options(arguments.maps);
  const pictures::MapPlan plan = pictures::plan_live_maps(options);
  if (!request.scenario.empty())
    scenario::read_scenario(request.scenario, request.settings);  // creates no folder for an invalid scenario
  if (!options.theta_c && plan.maps[0].theta_c_assumed && !arguments.quiet)
    print_error(
        "talus: note: the angle of repose is unknown before the slope fails: maps are scaled by {:g} deg; "
        "--set gamma_c=0.34 sets another threshold, its sine\n",
        pictures::assumed_theta_c);
  return std::optional<pictures::LiveMaps>(
      std::in_place, plan, arguments.frames, resumed, arguments.overwrite,
      [](const std::string& failure) { print_error("talus: warning: {}\n", failure); });
}

/// Whether the tilt of a scenario does not only grow.
bool goes_by_time(const scenario::Scenario& scenario) {
  return !scenario.tilt.program.empty() ||
         std::ranges::any_of(scenario.commands, [](const scenario::ScriptedCommand& command) {
           return command.kind == CommandKind::tilt_rate && command.x <= 0.0;
         });
}

void begin_maps(pictures::LiveMaps& maps, const OpenRun& open, const RunArguments& arguments) {
  const scenario::Scenario& scenario = open.session.scenario();
  const bool now = open.session.tilt_rate() <= 0.0;
  std::optional<io::RunFile> file;
  if (io::run_presence(arguments.output) == io::RunPresence::folder)
    file.emplace(io::RunFile::open(arguments.output));
  maps.begin(open.header, arguments.output, scenario.tilt.step,
             now || goes_by_time(scenario) || (file && file->goes_by_time()));
  if (file) maps.add_frames(*file);
}

/// Reports maps that could not be drawn last, because the run itself is complete.
void finish_maps(pictures::LiveMaps& maps, const RunArguments& arguments) {
  try {
    maps.finish();
  } catch (const Error& error) {
    throw Error(error.code(),
                "{}; the run is complete, but its maps in {} are not: draw them with talus render from {}",
                error.what(), arguments.frames, arguments.output);
  }
}

/// Draws the missing maps of a complete run that ended before all were drawn.
void draw_missing_maps(const RunArguments& arguments, const io::RunFile& file,
                       const scenario::Scenario& scenario) {
  std::optional<pictures::LiveMaps> maps = prepare_maps(arguments, request_of(arguments), true);
  if (!maps) return;
  maps->begin(file.header(), arguments.output, scenario.tilt.step,
              goes_by_time(scenario) || file.goes_by_time());
  maps->add_frames(file);
}

/// Finishes a complete run that was killed at its end: removes its folder and draws missing maps.
void resume_complete(const RunArguments& arguments) {
  const io::RunFile file = io::RunFile::open(arguments.output);
  const scenario::Scenario scenario = runs::stored_scenario(file.header(), arguments.output + ":/parameters");
  require_same_scenario(request_of(arguments), scenario);
  io::discard_folder(arguments.output);
  if (!arguments.quiet) print("{} is already complete.\n", arguments.output);
  draw_missing_maps(arguments, file, scenario);
}

OpenRun open_run(const RunArguments& arguments, const RunRequest& request, bool resumed) {
  OpenRun open = resumed ? resume_run(request) : start_run(request);
  open.session.use_threads(arguments.threads);
  if (const std::string& remark = open.session.bed_remark(); !remark.empty() && !arguments.quiet)
    print("{}\n", remark);
  note_missing_locks();  // reported now, because a run takes long
  const std::vector<scenario::ScriptedCommand>& commands = open.session.scenario().commands;
  const std::optional<double> end = open.session.scenario().tilt.end_angle;
  const bool will_hold = std::ranges::any_of(commands, [&](const scenario::ScriptedCommand& hold) {
    if (hold.kind != CommandKind::tilt_rate || hold.x != 0.0 || (hold.at && end && *hold.at > *end))
      return false;
    return std::ranges::none_of(
        commands,
        [&](const scenario::ScriptedCommand& later) {  // the tilt is held, so no angle is reached
          return later.kind == CommandKind::tilt_rate && later.x != 0.0 && later.time &&
                 (!hold.time || *later.time > *hold.time);
        });
  });
  if (will_hold || (open.session.schedule().course && open.session.tilt_rate() == 0.0))
    print_error(
        "talus: note: a command holds the tilt: unless the slope fails, the run continues until it is "
        "stopped\n");
  return open;
}

[[noreturn]] void end_stopped(const RunArguments& arguments, const World& world, bool by_signal) {
  throw Error(ExitCode::stopped, "stopped at {} deg{}; talus run --resume {} continues",
              degrees_text(world.tilt, 3), by_signal ? "" : " for --max-wall", arguments.output);
}

/// Draws maps of the frames during the run. Meanwhile the solver uses one thread fewer if no processor is
/// free, because threads that share a processor delay the others, which wait for them many times per step.
void draw_maps_during_run(pictures::LiveMaps& maps, int threads, session::Session& session,
                          session::RunControl& control) {
  const auto processors = static_cast<int>(std::thread::hardware_concurrency());
  const int fewer = processors > threads ? threads : std::max(1, threads - 1);
  control.on_frame = [&maps](const Frame& frame) { maps.add(frame); };
  control.on_step = [&maps, &session, threads, fewer,
                     report_step = std::move(control.on_step)](const session::RunProgress& progress) {
    report_step(progress);
    session.use_threads(maps.drawing() ? fewer : threads);
  };
}

void run(const RunArguments& arguments) {
  session::RunControl control;
  control.stop = stop_request();
  control.checkpoint = catch_checkpoint_signal();
  if (!arguments.max_wall.empty()) control.max_wall = parse_wall_time("--max-wall", arguments.max_wall);
  const io::RunPresence presence = io::run_presence(arguments.output);
  if (arguments.resume && presence == io::RunPresence::packed) return resume_complete(arguments);
  const RunRequest request = request_of(arguments);
  const bool resumed = arguments.resume && presence == io::RunPresence::folder;
  if (!resumed) io::require_run_name(arguments.output);  // before the folder of maps exists
  std::optional<pictures::LiveMaps> maps = prepare_maps(arguments, request, resumed);
  OpenRun open = open_run(arguments, request, resumed);
  if (maps) begin_maps(*maps, open, arguments);
  control.on_step = run_shown(arguments.quiet);
  if (maps) draw_maps_during_run(*maps, arguments.threads, open.session, control);
  const session::RunEnd end = [&] {
    const CommitOnSignals commit;
    return session::run_to_end(open.session, open.store, control);
  }();
  control.on_step = {};  // ends the line
  if (end == session::RunEnd::stopped) end_stopped(arguments, open.session.world(), *control.stop != 0);
  print_end(arguments, open.session);
  if (maps) finish_maps(*maps, arguments);
}

}  // namespace

void add_run_command(CLI::App& app) {
  auto arguments = std::make_shared<RunArguments>();
  CLI::App* command = app.add_subcommand("run", "Compute a run: deposition, rest, tilt to failure");
  command->add_option(
      "SCENARIO", arguments->scenario,
      "Scenario file (TOML; see docs/scenario.md), or the run to resume; optional with --branch");
  add_option(*command, "-o,--output", arguments->output, "FILE",
             "Run file to write (HDF5) [name of the scenario + .h5]");
  add_scenario_settings(*command, arguments->settings, " or, with --pictures, a parameter of maps");
  add_seed_option(*command, arguments->seed);
  add_threads_option(*command, arguments->threads, "Threads of the solver");
  CLI::Option* resume = command->add_flag("--resume", arguments->resume,
                                          "Continue from the last checkpoint: talus run --resume RUN. With "
                                          "SCENARIO -o RUN --resume a missing run is started");
  CLI::Option* branch =
      add_option(*command, "--branch", arguments->branch, "RUN",
                 "Start from a frame of this run, with its bed and, unless another is given, its scenario")
          ->excludes(resume);
  add_option(*command, "--at", arguments->at, "DEG",
             "Frame that the branch starts from: an angle in degrees, repose for the last frame before "
             "failure, or frameN")
      ->needs(branch);
  add_option(*command, "--max-wall", arguments->max_wall, "HH:MM[:SS]",
             "Stop with a checkpoint before this wall time is over");
  command
      ->add_flag("--overwrite", arguments->overwrite,
                 "Replace an existing run of this name; the old file is kept until the new run is complete")
      ->excludes(resume);
  command->add_flag("-q,--quiet", arguments->quiet, "Print errors and warnings only");
  CLI::Option* frames = add_option(
      *command, "--pictures", arguments->frames, "FOLDER",
      "Folder for maps of each frame, drawn during the run: gamma and overloaded, unless --map names others");
  add_map_options(*command, arguments->maps, MapOptionSet::drawn_live, frames);
  command->callback([arguments] {
    if (!arguments->branch.empty() && arguments->at.empty()) throw CLI::RequiredError("--at");
    take_map_settings(*arguments);
    settle_names(*arguments);
    run(*arguments);
  });
}

}  // namespace talus::app
