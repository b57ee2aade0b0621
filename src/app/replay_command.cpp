/// `talus replay`: recomputes a run from its scenario and its commands, and compares the end states.

#include <cstdio>
#include <fmt/core.h>
#include <memory>
#include <optional>

#include "app/command_line.h"
#include "app/commands.h"
#include "app/open_run.h"
#include "app/options.h"
#include "app/program_end.h"
#include "app/progress.h"
#include "app/run_files.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/hash.h"
#include "base/output_file.h"
#include "base/text.h"
#include "io/run_file.h"
#include "session/run_header.h"

namespace talus::app {
namespace {

struct ReplayArguments {
  std::string run;
  std::string output;  ///< empty: the recomputed run is not kept
  int threads = processor_count();
  bool overwrite = false;
  bool quiet = false;
};

std::string fact(const Facts& facts, const std::string& name) {
  return find_value(facts, name).value_or("unknown");
}

std::string end_text(const World& world) {
  return fmt::format("{} after {} steps", hash_text(state_hash(world)), world.step);
}

/// Throws if the output would replace the run that is replayed.
void refuse_same(const ReplayArguments& arguments) {
  output_target(arguments.output, output_of_run(arguments.run, true));
  const std::string output = resolved_path(arguments.output), run = resolved_path(arguments.run);
  if (output == run || io::run_folder(output) == run)
    throw Error(ExitCode::usage,
                arguments.output + " is the run that is replayed; choose another output with -o");
}

/// Creates the output, which records the run that it replays; until its end it lacks commands (resume_run).
std::optional<io::RunStore> begin_output(const ReplayArguments& arguments, const session::Session& session,
                                         const io::RunFile& run) {
  if (arguments.output.empty()) return std::nullopt;
  refuse_same(arguments);
  if (!arguments.overwrite && io::run_presence(arguments.output) != io::RunPresence::none)
    throw Error(ExitCode::cannot_create,
                "{} exists already; replace it with --overwrite, or choose another output with -o",
                arguments.output);
  io::RunHeader header = session::run_header(
      session, session::with_bed({run.header().scenario_given, fact(run.header().provenance, "scenario_file"),
                                  command_line(), arguments.threads, run.header().branch},
                                 session));
  header.provenance.emplace_back("replay_of", arguments.run);
  header.provenance.emplace_back("replay_steps", std::to_string(run.checkpoint().world.step));
  return io::RunStore::create(arguments.output, header, arguments.overwrite);
}

void compare(const ReplayArguments& arguments, const io::RunFile& run, const World& recomputed) {
  const World& stored = run.checkpoint().world;
  if (!arguments.quiet) print("stored      {}\nrecomputed  {}\n", end_text(stored), end_text(recomputed));
  if (state_hash(stored) == state_hash(recomputed)) return;
  // Runs of earlier versions do not record the bed that they started with.
  const std::string file = runs::stored_scenario(run.header(), arguments.run).deposition.file;
  const bool may_be_bed =
      !file.empty() && !run.header().branch && session::bed_of(run.header().provenance).empty();
  throw Error(
      ExitCode::internal,
      "{}: its scenario and commands give an end state that differs from the stored one; it was computed by "
      "version {}, whose results may differ in the last digits{}",
      arguments.run, runs::version_of(run.header().provenance),
      may_be_bed ? fmt::format(", or its bed (deposition.file) in {} has changed since", visible(file)) : "");
}

void replay_run(const ReplayArguments& arguments) {
  const io::RunFile run = io::RunFile::open(arguments.run);
  if (!run.has_state())
    throw Error(ExitCode::bad_data, arguments.run +
                                        " was repaired, and its last state is lost, so there is nothing to "
                                        "compare with; compute it again from its scenario (talus info)");
  if (!run.header().branch && !run.steps().empty() && at(run.steps().front(), StepField::step) != 1.0)
    throw Error(ExitCode::bad_data,
                arguments.run + " was repaired, and its first state is lost, so it cannot be computed again");
  const std::vector<Command> commands = run.commands();
  session::Session session = session::session_at_start(run.header(), arguments.run);
  session.use_threads(arguments.threads);
  std::optional<io::RunStore> store = begin_output(arguments, session, run);
  session::RunControl control;
  control.stop = stop_request();
  control.on_step = run_shown(arguments.quiet);
  if (!arguments.quiet)
    print("{}: {} steps, {}\n", arguments.run, run.checkpoint().world.step,
          counted(commands.size(), "command"));
  const session::RunEnd end = [&] {
    const CommitOnSignals commit;
    return session::replay(session, store ? &*store : nullptr, commands, run.checkpoint().world.step,
                           control);
  }();
  control.on_step = {};  // ends the line
  if (end == session::RunEnd::stopped)
    throw Error(ExitCode::stopped,
                "stopped after {} of {} steps: nothing was compared; repeat the replay from its start",
                session.world().step, run.checkpoint().world.step);
  compare(arguments, run, session.world());
}

}  // namespace

void add_replay_command(CLI::App& app) {
  auto arguments = std::make_shared<ReplayArguments>();
  CLI::App* command = app.add_subcommand(
      "replay", "Recompute a run from its scenario and its commands, and compare the end states");
  add_run_argument(*command, arguments->run);
  CLI::Option* output = add_option(*command, "-o,--output", arguments->output, "FILE",
                                   "Keep the recomputed run in this file (HDF5)");
  add_threads_option(*command, arguments->threads, "Threads of the solver");
  command
      ->add_flag("--overwrite", arguments->overwrite,
                 "Replace an existing run of this name; the old file is kept until the new run is complete")
      ->needs(output);
  command->add_flag("-q,--quiet", arguments->quiet, "Print errors and warnings only");
  command->callback([arguments] { replay_run(*arguments); });
}

}  // namespace talus::app
