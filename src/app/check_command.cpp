/// `talus check`: whether a scenario can be run, what it says in full, and what it will take; whether what a
/// run file holds is whole.

#include <cmath>
#include <cstdio>
#include <memory>

#include "app/commands.h"
#include "app/count_progress.h"
#include "app/json.h"
#include "core/errors.h"
#include "io/run_repair.h"
#include "session/estimate.h"
#include "session/run_check.h"
#include "session/scenario_keys.h"

namespace talus {
namespace {

struct CheckArguments {
  std::string scenario;
  std::vector<std::string> settings;
  bool json = false;
};

std::string json_value(const ScenarioValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return json::number(*whole);
  if (const auto* number = std::get_if<double>(&value)) return json::number(*number);
  return json::quoted(std::get<std::string>(value));
}

/// Keys of one section; those above the first section for an empty name.
json::Members section_members(const Scenario& scenario, const std::string& section) {
  json::Members members;
  for (const ScenarioKey& key : scenario_keys())
    if (key.section == section) members.emplace_back(key.name, json_value(key.get(scenario)));
  return members;
}

std::string scenario_json(const Scenario& scenario) {
  json::Members members = section_members(scenario, "");
  std::string section;
  for (const ScenarioKey& key : scenario_keys()) {
    if (key.section == section) continue;
    section = key.section;
    members.emplace_back(section, json::object(section_members(scenario, section), 2));
  }
  return json::object(members, 1);
}

void print_json(const CheckArguments& arguments, const Scenario& scenario, const Estimate& expected) {
  const json::Members estimates = {
      {"grains", json::number(expected.grains)},
      {"floor_grains", json::number(expected.floor_grains)},
      {"contacts", json::number(expected.contacts)},
      {"time_step_s", json::number(expected.time_step)},
      {"deposition_steps", json::number(expected.deposition_steps)},
      {"tilt_steps", json::number(expected.tilt_steps)},
      {"frames", json::number(expected.frames)},
      {"observable_rows", json::number(expected.observable_rows)},
      {"time_s", json::number(expected.seconds)},
      {"memory_bytes", json::number(expected.memory)},
      {"disk_bytes", json::number(expected.disk)},
  };
  const json::Members members = {
      {"path", json::quoted(arguments.scenario)},
      {"valid", "true"},
      {"scenario", scenario_json(scenario)},
      {"estimate", json::object(estimates, 1)},
  };
  std::printf("%s\n", json::object(members).c_str());
}

std::string duration(double seconds) {
  char text[32];
  if (seconds < 90.0)
    std::snprintf(text, sizeof text, "%.0f s", std::ceil(seconds));
  else if (seconds < 5400.0)
    std::snprintf(text, sizeof text, "%.0f min", seconds / 60.0);
  else if (seconds < 172800.0)
    std::snprintf(text, sizeof text, "%.1f h", seconds / 3600.0);
  else
    std::snprintf(text, sizeof text, "%.0f days", seconds / 86400.0);
  return text;
}

std::string size_text(double bytes) {
  char text[32];
  if (bytes < 1e9)
    std::snprintf(text, sizeof text, "%.0f MB", std::ceil(bytes / 1e6));
  else
    std::snprintf(text, sizeof text, "%.1f GB", bytes / 1e9);
  return text;
}

std::string count(std::int64_t number) { return std::to_string(number); }

void print_line(const char* name, const std::string& text) {
  std::printf("#   %-11s %s\n", name, text.c_str());
}

/// All of it is a scenario again: what is not TOML stands in comments.
void print_text(const CheckArguments& arguments, const Scenario& scenario, const Estimate& expected) {
  std::printf("# %s is valid\n\n%s\n", arguments.scenario.c_str(), resolved_toml(scenario).c_str());
  std::printf("# Estimates\n");
  print_line("grains", count(expected.grains) + " free, " + count(expected.floor_grains) + " on the floor");
  print_line("contacts", "about " + count(expected.contacts) + " at rest");
  print_line("time step", short_text(expected.time_step) + " s (tilt.step / tilt.rate)");
  print_line("steps",
             "about " + count(expected.deposition_steps) + " of deposition, " +
                 (scenario.tilt.end_angle ? "" : "about ") + count(expected.tilt_steps) + " of tilt" +
                 (scenario.tilt.end_angle ? "" : " (failure at " + short_text(assumed_repose) + " deg)"));
  print_line("output",
             count(expected.frames) + " frames, " + count(expected.observable_rows) + " rows of observables");
  print_line("time", "about " + duration(expected.seconds) + " on one core");
  print_line("memory", "up to about " + size_text(expected.memory));
  print_line("disk", "about " + size_text(expected.disk) + ", twice that while the run is packed");
}

/// Throws `refusal` again, after it has said which pieces of the run are damaged.
[[noreturn]] void tell_damage(const CheckArguments& arguments, const Error& refusal) {
  const std::vector<std::string> pieces = damaged_pieces(arguments.scenario);
  if (arguments.json) {
    const json::Members members = {{"path", json::quoted(arguments.scenario)},
                                   {"whole", json::truth(false)},
                                   {"faults", json::array(pieces)}};
    std::printf("%s\n", json::object(members).c_str());
  } else {
    std::printf("%s: damaged\n", arguments.scenario.c_str());
    for (const std::string& piece : pieces) std::printf("  fault: %s\n", piece.c_str());
    if (pieces.empty()) std::printf("  every piece of the run itself is whole\n");
  }
  throw Error(refusal);
}

/// The run, whose bytes are those that were written.
RunFile open_or_tell(const CheckArguments& arguments) {
  try {
    return RunFile::open(arguments.scenario);
  } catch (const Error& error) {
    if (error.code() != ExitCode::bad_data) throw;
    tell_damage(arguments, error);
  }
}

void print_run_json(const std::string& path, const RunFile& run, const RunCheck& check) {
  const json::Members members = {
      {"path", json::quoted(path)},
      {"whole", json::truth(check.faults.empty())},
      {"complete", json::truth(run.complete())},
      {"lost", json::quoted(run.lost())},
      {"frames", json::number(check.frames)},
      {"observable_rows", json::number(check.rows)},
      {"steps", json::number(check.steps)},
      {"commands", json::number(check.commands)},
      {"largest_overlap_d", json::number(check.largest_overlap)},
      {"largest_mobilisation", json::number(check.largest_mobilisation)},
      {"frames_at_rest", json::number(check.frames_at_rest)},
      {"largest_imbalance_mg", json::number(check.largest_imbalance)},
      {"largest_moment_error", json::number(check.largest_moment_error)},
      {"faults", json::array(check.faults)},
  };
  std::printf("%s\n", json::object(members).c_str());
}

void print_run(const std::string& path, const RunFile& run, const RunCheck& check) {
  std::printf("%s: %s, %s\n", path.c_str(), check.faults.empty() ? "whole" : "damaged",
              run.complete() ? "complete" : "not complete");
  if (!run.lost().empty()) std::printf("  lost        %s (before it was repaired)\n", run.lost().c_str());
  std::printf("  hashes      as they were written\n");
  std::printf("  series      %zu frames, %zu rows of observables, %zu steps, %zu commands\n", check.frames,
              check.rows, check.steps, check.commands);
  std::printf("  overlap     at most %.2g D\n", check.largest_overlap);
  std::printf("  friction    at most %.6f of what Coulomb's law allows\n", check.largest_mobilisation);
  std::printf("  balance     forces and weight differ by at most %.2g m g (rms) in %zu frames at rest\n",
              check.largest_imbalance, check.frames_at_rest);
  std::printf("  moments     differ from those of the contacts by at most %.2g of the largest\n",
              check.largest_moment_error);
  for (const std::string& fault : check.faults) std::printf("  fault: %s\n", fault.c_str());
}

/// Throws Error(bad_data) where the run is damaged, after it has said how.
void check_run_file(const CheckArguments& arguments) {
  if (!arguments.settings.empty())
    throw Error(ExitCode::usage, arguments.scenario + " is a run: --set is for a scenario");
  const RunFile run = open_or_tell(arguments);
  RunCheck check = [&] {
    CountProgress progress("checking", run.all_frame_tilts().size(), arguments.json);
    return check_run(run, [&progress](std::size_t done) { progress.show(done); });
  }();
  // Of a folder every file has been compared with its hash, and its writer may be at work.
  const auto pieces = run.complete() ? damaged_pieces(arguments.scenario) : std::vector<std::string>{};
  check.faults.insert(check.faults.begin(), pieces.begin(), pieces.end());
  if (arguments.json)
    print_run_json(arguments.scenario, run, check);
  else
    print_run(arguments.scenario, run, check);
  if (!check.faults.empty())
    throw Error(ExitCode::bad_data, arguments.scenario + " is damaged: " + check.faults.front());
}

}  // namespace

void add_check_command(CLI::App& app) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command = app.add_subcommand("check",
                                         "Check a scenario, print it with every key, and estimate time, "
                                         "memory and disk; or check what a run file holds");
  command
      ->add_option("scenario", arguments->scenario,
                   "Scenario file (TOML; see docs/scenario.md) or run file (RUN.h5)")
      ->required();
  command
      ->add_option("--set", arguments->settings,
                   "Change a key of the scenario, e.g. --set contact.friction=0.3")
      ->allow_extra_args(false);
  command->add_flag("--json", arguments->json, "As JSON, with units in the names");
  command->callback([arguments] {
    if (is_run(arguments->scenario)) return check_run_file(*arguments);
    const Scenario scenario = read_scenario(arguments->scenario, arguments->settings);
    const Estimate expected = estimate(scenario);
    if (arguments->json)
      print_json(*arguments, scenario, expected);
    else
      print_text(*arguments, scenario, expected);
  });
}

}  // namespace talus
