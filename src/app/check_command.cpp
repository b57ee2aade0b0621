/// `talus check`: whether a scenario can be run, what it says in full, and what it will take.

#include <cmath>
#include <cstdio>
#include <memory>

#include "app/commands.h"
#include "app/json.h"
#include "session/estimate.h"
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

}  // namespace

void add_check_command(CLI::App& app) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command = app.add_subcommand(
      "check", "Check a scenario, print it with every key, and estimate time, memory and disk");
  command->add_option("scenario", arguments->scenario, "Scenario file (TOML; see docs/scenario.md)")
      ->required();
  command
      ->add_option("--set", arguments->settings,
                   "Change a key of the scenario, e.g. --set contact.friction=0.3")
      ->allow_extra_args(false);
  command->add_flag("--json", arguments->json, "As JSON, with units in the names");
  command->callback([arguments] {
    const Scenario scenario = read_scenario(arguments->scenario, arguments->settings);
    const Estimate expected = estimate(scenario);
    if (arguments->json)
      print_json(*arguments, scenario, expected);
    else
      print_text(*arguments, scenario, expected);
  });
}

}  // namespace talus
