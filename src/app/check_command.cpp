/// `talus check`: validates a scenario, prints it in full and estimates its cost; or checks that a run file
/// is intact.

#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <memory>

#include "app/commands.h"
#include "app/json.h"
#include "app/progress.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/text.h"
#include "io/run_repair.h"
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

void print_json(const CheckArguments& arguments, const scenario::Scenario& scenario,
                const session::Estimate& expected) {
  const Json estimate = {{"grains", expected.grains},
                         {"floor_grains", expected.floor_grains},
                         {"contacts", expected.contacts},
                         {"time_step_s", expected.time_step},
                         {"deposition_steps", expected.deposition_steps},
                         {"tilt_steps", expected.tilt_steps},
                         {"program_parts", expected.program_parts},
                         {"flow_steps", expected.flow_steps},
                         {"frames", expected.frames},
                         {"observable_rows", expected.observable_rows},
                         {"time_s", expected.seconds},
                         {"memory_bytes", expected.memory},
                         {"disk_bytes", expected.disk}};
  const Json json = {{"path", arguments.scenario},
                     {"valid", true},
                     {"scenario", scenario_json(scenario)},
                     {"estimate", estimate}};
  print("%s\n", json_text(json).c_str());
}

std::string duration(double seconds) {
  if (seconds < 90.0) return fmt::format("{:.0f} s", std::ceil(seconds));
  if (seconds < 5400.0) return fmt::format("{:.0f} min", seconds / 60.0);
  if (seconds < 172800.0) return fmt::format("{:.1f} h", seconds / 3600.0);
  return fmt::format("{:.0f} days", seconds / 86400.0);
}

void print_line(const char* name, const std::string& text) { print("#   %-11s %s\n", name, text.c_str()); }

/// Prints text that is itself a valid scenario: everything that is not TOML is a comment.
void print_report(const CheckArguments& arguments, const scenario::Scenario& scenario,
                  const session::Estimate& expected) {
  print("# %s is valid\n\n%s\n", arguments.scenario.c_str(), scenario::resolved_toml(scenario).c_str());
  if (std::string remark; scenario.deposition.method == scenario::DepositionMethod::file) {
    session::initial_bed(scenario, &remark);
    if (!remark.empty()) print("# %s\n\n", remark.c_str());
  }
  print("# Estimates\n");
  print_line("grains", fmt::format("{} free, {} on the floor", expected.grains, expected.floor_grains));
  print_line("contacts", fmt::format("about {} at rest", expected.contacts));
  print_line("time step", scenario::short_text(expected.time_step) + " s (tilt.step / tilt.rate)");
  const scenario::TiltProgram program(scenario);
  const bool until_failure = program.empty() ? !scenario.tilt.end_angle : program.ends_at_repose();
  if (!program.empty())
    print_line("programme",
               fmt::format(
                   "{} parts, repetitions included, {} s{}", program.segments().size(),
                   scenario::short_text(
                       std::round(1e3 * expected.time_step * static_cast<double>(expected.tilt_steps)) / 1e3),
                   until_failure ? fmt::format(" if it fails at {} deg", session::assumed_repose) : ""));
  print_line(
      "steps",
      fmt::format("about {} of deposition, {}{} of tilt{}{}", expected.deposition_steps,
                  until_failure ? "about " : "", expected.tilt_steps,
                  until_failure ? fmt::format(" (failure at {} deg)", session::assumed_repose) : "",
                  expected.flow_steps > 0 ? fmt::format(", at most {} of flow", expected.flow_steps) : ""));
  print_line("output",
             fmt::format("{}, {} of observables", counted(static_cast<std::size_t>(expected.frames), "frame"),
                         counted(static_cast<std::size_t>(expected.observable_rows), "row")));
  print_line("time", fmt::format("about {} on one core", duration(expected.seconds)));
  print_line("memory", "up to about " + session::size_text(expected.memory));
  print_line("disk", fmt::format("about {}, 2.5 times that while the run is packed",
                                 session::size_text(expected.disk)));
}

/// Reports which pieces of the run are damaged, then rethrows `refusal`.
[[noreturn]] void report_damage(const CheckArguments& arguments, const Error& refusal) {
  const std::vector<std::string> pieces = io::damaged_pieces(arguments.scenario);
  if (arguments.json) {
    const Json json = {{"path", arguments.scenario}, {"whole", false}, {"faults", pieces}};
    print("%s\n", json_text(json).c_str());
  } else {
    print("%s: damaged\n", arguments.scenario.c_str());
    for (const std::string& piece : pieces) print("  fault: %s\n", piece.c_str());
    if (pieces.empty()) print("  every piece of the run itself is intact\n");
  }
  throw Error(refusal);
}

/// Opens the run after its hashes were verified; reports the damage and throws if they do not match.
io::RunFile open_verified(const CheckArguments& arguments) {
  try {
    return io::RunFile::open(arguments.scenario);
  } catch (const Error& error) {
    if (error.code() != ExitCode::bad_data) throw;
    report_damage(arguments, error);
  }
}

void print_run_json(const std::string& path, const io::RunFile& run, const session::RunCheck& check) {
  const Json json = {{"path", path},
                     {"whole", check.faults.empty()},
                     {"complete", run.complete()},
                     {"lost", run.lost()},
                     {"frames", check.frames},
                     {"observable_rows", check.rows},
                     {"steps", check.steps},
                     {"commands", check.commands},
                     {"largest_overlap_d", check.largest_overlap},
                     {"largest_mobilisation", check.largest_mobilisation},
                     {"frames_at_rest", check.frames_at_rest},
                     {"largest_imbalance_mg", check.largest_imbalance},
                     {"largest_moment_error", check.largest_moment_error},
                     {"faults", check.faults}};
  print("%s\n", json_text(json).c_str());
}

void print_run(const std::string& path, const io::RunFile& run, const session::RunCheck& check) {
  print("%s: %s, %s\n", path.c_str(), check.faults.empty() ? "intact" : "damaged",
        run.complete() ? "complete" : "incomplete");
  if (!run.lost().empty()) print("  lost        %s (before it was repaired)\n", run.lost().c_str());
  if (check.changed == 0)
    print("  hashes      correct\n");
  else
    print("  hashes      wrong for %zu of the data sets and frames\n", check.changed);
  print("  series      %s, %s of observables, %s, %s\n", counted(check.frames, "frame").c_str(),
        counted(check.rows, "row").c_str(), counted(check.steps, "step").c_str(),
        counted(check.commands, "command").c_str());
  if (run.has_frames()) {
    print("  overlap     at most %.2g D\n", check.largest_overlap);
    print("  friction    at most %.6f of the Coulomb limit\n", check.largest_mobilisation);
    print("  balance     forces and weight differ by at most %.2g m g (rms) in %s at rest\n",
          check.largest_imbalance, counted(check.frames_at_rest, "frame").c_str());
    print("  moments     differ from those of the contacts by at most %.2g of the largest\n",
          check.largest_moment_error);
  } else {
    print("  frames      not kept (--keep analysis), so not checked\n");
  }
  for (const std::string& fault : check.faults) print("  fault: %s\n", fault.c_str());
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
  if (arguments.json)
    print_run_json(arguments.scenario, run, check);
  else
    print_run(arguments.scenario, run, check);
  if (!check.faults.empty())
    throw Error(ExitCode::bad_data,
                fmt::format("{} is damaged: {}", arguments.scenario, check.faults.front()));
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
  command
      ->add_option("--set", arguments->settings,
                   "Change a key of the scenario, e.g. --set contact.friction=0.3")
      ->allow_extra_args(false);
  command->add_flag("--json", arguments->json, "Print JSON, with units in the names");
  command->callback([arguments] {
    if (io::is_run(arguments->scenario)) return check_run_file(*arguments);
    const scenario::Scenario scenario = scenario::read_scenario(arguments->scenario, arguments->settings);
    const session::Estimate expected = session::estimate(scenario);
    if (arguments->json)
      print_json(*arguments, scenario, expected);
    else
      print_report(*arguments, scenario, expected);
  });
}

}  // namespace talus::app
