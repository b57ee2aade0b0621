#include "figures/run_group.h"

#include <algorithm>
#include <filesystem>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/paths.h"
#include "base/version.h"
#include "scenario/keys.h"
#include "scenario/text.h"
#include "session/run_identity.h"

namespace talus::figures {
namespace {

/// Returns the scenario with all settings that do not affect the result at their defaults; runs of one group
/// agree in it. The end of a run and its output do not affect the result; a tolerance of the solver may.
scenario::Scenario essence(scenario::Scenario scenario) {
  const scenario::Scenario plain;
  scenario.seed = plain.seed;
  scenario.output = plain.output;
  scenario.tilt.end_angle = plain.tilt.end_angle;
  scenario.tilt.after_failure = plain.tilt.after_failure;
  scenario.tilt.lowering_rate = plain.tilt.lowering_rate;
  scenario.deposition.max_time = plain.deposition.max_time;
  if (scenario.bed.boundary == scenario::BedBoundary::periodic)
    scenario.contact.wall_friction = plain.contact.wall_friction;
  return scenario;
}

std::string bed_label(const scenario::Scenario& scenario) {
  return fmt::format("{}, L = {} D", scenario.bed.boundary == scenario::BedBoundary::periodic ? "PBC" : "WBC",
                     scenario::short_text(scenario.bed.length));
}

scenario::Scenario essence_of(const RunGroup& group) { return essence(group.runs.front().scenario); }

/// Whether the run belongs to the group. It does not if the group has another run with its seed: results may
/// differ in bits between versions of Talus.
bool belongs_to(const RunGroup& group, const runs::RunView& run, const std::vector<std::string>& departures) {
  return essence_of(group) == essence(run.scenario) && group.departures == departures &&
         std::ranges::none_of(group.runs, [&](const runs::RunView& other) {
           return other.scenario.seed == run.scenario.seed && other.state_hash != run.state_hash;
         });
}

/// Returns what distinguishes a run from others of its scenario. Stored values are those of members of an
/// ensemble, which are runs of their scenario alone.
std::vector<std::string> departures_of(const runs::RunView& run) {
  if (!run.file) return {};
  std::vector<std::string> found = session::departures(*run.file, run.scenario);
  const std::string by = find_value(run.file->header().provenance, "version").value_or("unknown");
  if (by != version) found.push_back("computed by version " + by);
  return found;
}

/// Returns the name of the folder of the first run.
std::string folder_name(const RunGroup& group) {
  const std::string& path = group.runs.front().path;
  return std::filesystem::path(absolute_path(path.substr(0, path.find('#'))))
      .parent_path()
      .filename()
      .string();
}

/// Adds the folders to labels that several groups share.
void distinguish_folders(std::vector<RunGroup>& groups) {
  std::vector<std::string> labels;
  for (const RunGroup& group : groups) labels.push_back(group.label);
  for (RunGroup& group : groups)
    if (std::ranges::count(labels, group.label) > 1) group.label += ", " + folder_name(group);
}

/// Adds the keys in which they differ to the labels that several groups share.
void distinguish_by_name(std::vector<RunGroup>& groups) {
  std::vector<std::string> additions(groups.size()), names;
  for (const RunGroup& group : groups)
    if (auto more = scenario::key_names(essence_of(group)); more.size() > names.size())
      names = std::move(more);
  for (const std::string& name : names)
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const std::string value = scenario::value_text(essence_of(groups[g]), name);
      const auto differs = [&](const RunGroup& other) {
        return other.label == groups[g].label && scenario::value_text(essence_of(other), name) != value;
      };
      if (std::ranges::any_of(groups, differs)) additions[g] += fmt::format(", {} = {}", name, value);
    }
  for (std::size_t g = 0; g < groups.size(); ++g) groups[g].label += additions[g];
}

void sort_by_seed(RunGroup& group) {
  const auto seed = [](const runs::RunView& run) { return run.scenario.seed; };
  std::ranges::sort(group.runs, {}, seed);
  const auto twice = std::ranges::adjacent_find(group.runs, {}, seed);
  if (twice != group.runs.end())
    throw Error(ExitCode::bad_data,
                fmt::format("{} and {} are the same run (same scenario and seed); give only one of them",
                            twice->path, std::next(twice)->path));
}

}  // namespace

std::vector<RunGroup> group_runs(std::vector<runs::RunView> runs) {
  std::vector<RunGroup> groups;
  for (runs::RunView& run : runs) {
    const std::vector<std::string> departures = departures_of(run);
    auto group =
        std::ranges::find_if(groups, [&](const RunGroup& each) { return belongs_to(each, run, departures); });
    if (group == groups.end())
      group = groups.insert(group, RunGroup{bed_label(run.scenario), {}, departures});
    group->runs.push_back(std::move(run));
  }
  distinguish_by_name(groups);
  for (RunGroup& group : groups)
    if (!group.departures.empty()) group.label += ", " + session::departures_text(group.departures);
  distinguish_folders(groups);
  std::ranges::for_each(groups, sort_by_seed);
  std::ranges::stable_sort(groups, {}, [](const RunGroup& group) {
    return group.periodic() ? 0.0 : group.runs.front().scenario.bed.length;
  });
  return groups;
}

}  // namespace talus::figures
