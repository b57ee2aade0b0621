/// `talus check`: validates a scenario and estimates its cost, or checks that a run is intact.

#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <memory>

#include "app/commands.h"
#include "app/json.h"
#include "app/options.h"
#include "app/progress.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/text.h"
#include "io/durable_file.h"
#include "io/run_file.h"
#include "scenario/keys.h"
#include "scenario/scripted_command.h"
#include "scenario/text.h"
#include "scenario/tilt_program.h"
#include "session/deposition.h"
#include "session/estimate.h"
#include "session/run_check.h"

namespace talus::app {
namespace {

struct CheckArguments {
  std::string scenario;
  std::vector<std::string> settings;
  bool json = false;
};

/// Returns the scenario with every key, by section.
Json scenario_json(const scenario::Scenario& scenario) {
  Json json = Json::object();
  for (const scenario::ScenarioKey& key : scenario::scenario_keys()) {
    Json& section = key.section.empty() ? json : json[key.section];
    section[key.name] = std::visit([](const auto& value) -> Json { return value; }, key.get(scenario));
  }
  for (const scenario::ScriptedCommand& command : scenario.commands) {
    Json& table = json["command"].emplace_back(Json::object());
    for (const scenario::CommandKey& key : scenario::command_keys())
      table[key.name] = std::visit([](const auto& value) -> Json { return value; }, key.get(command));
  }
  return json;
}

std::vector<Fact> facts_of(const scenario::Scenario& scenario, const session::Estimate& expected) {
  const scenario::TiltProgram program(scenario);
  const bool until_failure = program.empty() ? !scenario.tilt.end_angle : program.ends_at_repose();
  const auto at_failure = [until_failure](const char* format) {
    return until_failure ? fmt::format(fmt::runtime(format), session::assumed_repose) : "";
  };
  return {
      {"grains", fmt::format("{} free, {} on the floor", expected.grains, expected.floor_grains), "grains",
       expected.grains},
      {"", "", "floor_grains", expected.floor_grains},
      {"contacts", fmt::format("about {} at rest", expected.contacts), "contacts", expected.contacts},
      {"time step", scenario::short_text(expected.time_step) + " s (tilt.step / tilt.rate)", "time_step_s",
       expected.time_step},
      {program.empty() ? "" : "programme",
       fmt::format("{} parts, repetitions included, {} s{}", program.segments().size(),
                   scenario::short_text(
                       std::round(1e3 * expected.time_step * static_cast<double>(expected.tilt_steps)) / 1e3),
                   at_failure(" if it fails at {} deg")),
       "program_parts", expected.program_parts},
      {"steps",
       fmt::format("about {} of deposition, {}{} of tilt{}{}", expected.deposition_steps,
                   until_failure ? "about " : "", expected.tilt_steps, at_failure(" (failure at {} deg)"),
                   expected.flow_steps > 0 ? fmt::format(", at most {} of flow", expected.flow_steps) : ""),
       "deposition_steps", expected.deposition_steps},
      {"", "", "tilt_steps", expected.tilt_steps},
      {"", "", "flow_steps", expected.flow_steps},
      {"output",
       fmt::format("{}, {} of observables", counted(static_cast<std::size_t>(expected.frames), "frame"),
                   counted(static_cast<std::size_t>(expected.observable_rows), "row")),
       "frames", expected.frames},
      {"", "", "observable_rows", expected.observable_rows},
      {"time", fmt::format("about {} on one core", session::duration_text(expected.seconds)), "time_s",
       expected.seconds},
      {"memory", "up to about " + session::size_text(expected.memory), "memory_bytes", expected.memory},
      {"disk",
       fmt::format("about {}, 2.5 times that while the run is packed", session::size_text(expected.disk)),
       "disk_bytes", expected.disk}};
}

/// Prints JSON, or text that is itself a valid scenario: everything that is not TOML is a comment.
void check_scenario(const CheckArguments& arguments) {
  const scenario::Scenario scenario = scenario::read_scenario(arguments.scenario, arguments.settings);
  const std::vector<Fact> facts = facts_of(scenario, session::estimate(scenario));
  if (arguments.json)
    return print_text(json_text({{"path", arguments.scenario},
                                 {"valid", true},
                                 {"scenario", scenario_json(scenario)},
                                 {"estimate", members_of(facts)}}) +
                      "\n");
  print("# {} is valid\n\n{}\n", arguments.scenario, scenario::resolved_toml(scenario));
  if (std::string remark; scenario.deposition.method == scenario::DepositionMethod::file) {
    session::initial_bed(scenario, &remark);
    if (!remark.empty()) print("# {}\n\n", remark);
  }
  print_text("# Estimates\n" + lines_of(facts, 12, "#   "));
}

/// Reports which pieces of the run are damaged, then rethrows `refusal`.
[[noreturn]] void report_damage(const CheckArguments& arguments, const Error& refusal) {
  const std::vector<std::string> pieces = io::damaged_pieces(arguments.scenario);
  std::vector<Fact> facts = {
      {"", "", "path", arguments.scenario}, {"", "", "whole", false}, {"", "", "faults", pieces}};
  for (const std::string& piece : pieces) facts.push_back({"fault: " + piece, ""});
  if (pieces.empty()) facts.push_back({"every piece of the run itself is intact", ""});
  if (!arguments.json) print("{}: damaged\n", arguments.scenario);
  print_facts(facts, arguments.json, 0, "  ");
  throw Error(refusal);
}

/// Opens the run after its hashes were verified; reports the damage and throws if they do not match.
io::RunFile open_verified(const CheckArguments& arguments) {
  try {
    return io::RunFile::open(arguments.scenario);
  } catch (const Error& error) {
    if (error.code() != ExitCode::bad_data || io::begins_as_averages(arguments.scenario)) throw;
    report_damage(arguments, error);
  }
}

std::vector<Fact> facts_of(const std::string& path, const io::RunFile& run, const session::RunCheck& check) {
  const auto shown = [&run](const char* label) { return std::string(run.has_frames() ? label : ""); };
  std::vector<Fact> facts = {
      {"", "", "path", path},
      {"", "", "whole", check.faults.empty()},
      {"", "", "complete", run.complete()},
      {run.lost().empty() ? "" : "lost", run.lost() + " (before it was repaired)", "lost", run.lost()},
      {"hashes", check.changed == 0 ? "correct"
                                    : fmt::format("wrong for {} of the data sets and frames", check.changed)},
      {"series",
       fmt::format("{}, {} of observables, {}, {}", counted(check.frames, "frame"),
                   counted(check.rows, "row"), counted(check.steps, "step"),
                   counted(check.commands, "command")),
       "frames", check.frames},
      {"", "", "observable_rows", check.rows},
      {"", "", "steps", check.steps},
      {"", "", "commands", check.commands},
      {shown("overlap"), fmt::format("at most {:.2g} D", check.largest_overlap), "largest_overlap_d",
       check.largest_overlap},
      {shown("friction"), fmt::format("at most {:.6f} of the Coulomb limit", check.largest_mobilisation),
       "largest_mobilisation", check.largest_mobilisation},
      {"", "", "frames_at_rest", check.frames_at_rest},
      {shown("balance"),
       fmt::format("forces and weight differ by at most {:.2g} m g (rms) in {} at rest",
                   check.largest_imbalance, counted(check.frames_at_rest, "frame")),
       "largest_imbalance_mg", check.largest_imbalance},
      {shown("moments"),
       fmt::format("differ from those of the contacts by at most {:.2g} of the largest",
                   check.largest_moment_error),
       "largest_moment_error", check.largest_moment_error}};
  if (!run.has_frames()) facts.push_back({"frames", "not kept (--keep analysis), so not checked"});
  for (const std::string& fault : check.faults) facts.push_back({"fault: " + fault, ""});
  facts.push_back({"", "", "faults", check.faults});
  return facts;
}

/// Prints the result of all checks; throws Error(bad_data) if the run is damaged.
void check_run_file(const CheckArguments& arguments) {
  if (!arguments.settings.empty())
    throw Error(ExitCode::usage, arguments.scenario + " is a run; --set applies to a scenario");
  const io::RunFile run = open_verified(arguments);
  const session::RunCheck check = [&] {
    const std::size_t frames = run.all_frame_tilts().size();
    const CountDone progress = count_shown("checking", arguments.json);
    progress(0, frames);
    return session::check_run(run, [&](std::size_t done) { progress(done, frames); });
  }();
  if (!arguments.json)
    print("{}: {}, {}\n", arguments.scenario, check.faults.empty() ? "intact" : "damaged",
          run.complete() ? "complete" : "incomplete");
  print_facts(facts_of(arguments.scenario, run, check), arguments.json, 12, "  ");
  if (!check.faults.empty())
    throw Error(ExitCode::bad_data, "{} is damaged: {}", arguments.scenario, check.faults.front());
}

}  // namespace

void add_check_command(CLI::App& app) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command = app.add_subcommand("check",
                                         "Check a scenario, print it with every key, and estimate time, "
                                         "memory and disk space; or check the contents of a run file");
  command
      ->add_option("SCENARIO", arguments->scenario,
                   "Scenario file (TOML; see docs/scenario.md) or run file (RUN.h5)")
      ->required();
  add_scenario_settings(*command, arguments->settings);
  command->add_flag("--json", arguments->json, "Print JSON, with units in the names");
  command->callback([arguments] {
    if (io::is_run(arguments->scenario)) return check_run_file(*arguments);
    check_scenario(*arguments);
  });
}

namespace {

struct RepairArguments {
  std::string run;
  std::string output;
  bool overwrite = false;
};

void print_lines(const char* name, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) print("  {:<5} {}\n", name, line);
}

void repair(const RepairArguments& arguments) {
  const io::RepairReport report = io::repair_run({arguments.run, arguments.output, arguments.overwrite});
  if (report.was_whole) {
    print("{} is intact: nothing to repair, and nothing was written\n", arguments.run);
    return;
  }
  print("{}: intact pieces of {}\n", arguments.output, arguments.run);
  print_lines("kept", report.kept);
  print_lines("lost", report.lost);
  if (report.of_folder)
    print("it cannot be continued; talus info prints its scenario, to compute it again\n");
}

}  // namespace

void add_repair_command(CLI::App& app) {
  auto arguments = std::make_shared<RepairArguments>();
  CLI::App* command = app.add_subcommand(
      "repair", "Save the intact pieces of a damaged run as a new run; the damaged run is not changed");
  add_run_argument(*command, arguments->run);
  add_option(*command, "-o,--output", arguments->output, "FILE",
             "New run (HDF5); a missing folder is created")
      ->required();
  command->add_flag("--overwrite", arguments->overwrite, "Replace an existing run of this name");
  command->callback([arguments] { repair(*arguments); });
}

}  // namespace talus::app
