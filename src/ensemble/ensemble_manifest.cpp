#include "ensemble/ensemble_manifest.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fmt/core.h>
#include <optional>
#include <span>
#include <sstream>

#include "core/errors.h"
#include "core/hash.h"
#include "core/locked_file.h"
#include "core/output_file.h"
#include "core/text.h"
#include "core/text_stream.h"
#include "core/version.h"
#include "ensemble/axes.h"
#include "io/durable_file.h"
#include "io/mistaken_path.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

constexpr const char* first_line = "talus ensemble 1";

std::string hash_of(const std::string& text) { return hash_text(hash_bytes(std::as_bytes(std::span(text)))); }

/// DIR/scenarios/contact.friction=0.3.toml, DIR/scenarios/scenario.toml.
std::string scenario_path(const std::string& folder, const std::string& variant) {
  const std::string name = variant.empty() ? "scenario" : variant;
  return (fs::path(folder) / "scenarios" / (name + ".toml")).string();
}

/// "1-3,8", which parse_seeds reads.
std::string seeds_text(const std::vector<std::uint64_t>& seeds) {
  std::vector<std::string> parts;
  for (auto first = seeds.begin(); first != seeds.end();) {
    auto last = first;
    while (last + 1 != seeds.end() && *(last + 1) == *last + 1) ++last;
    parts.push_back(first == last ? std::to_string(*first) : fmt::format("{}-{}", *first, *last));
    first = last + 1;
  }
  return joined(parts, ",");
}

/// The scenarios are written already, and stay as they are: another version of Talus would write them
/// otherwise.
std::string text_of(const EnsembleManifest& manifest) {
  std::string text =
      fmt::format("{}\nversion {}\nseeds {}\n", first_line, manifest.version, seeds_text(manifest.seeds));
  if (!manifest.until.empty()) text += fmt::format("until {}\n", manifest.until);
  if (const std::string task = task_text(manifest.task); !task.empty())
    text += fmt::format("task {}\n", task);
  if (!manifest.keep.empty()) text += fmt::format("keep {}\n", manifest.keep);
  for (const Variant& variant : manifest.variants)
    text += fmt::format("variant {} {}\n", hash_of(read_text(variant.scenario_file)), variant.name);
  return fmt::format("{}hash {}\n", text, hash_of(text));
}

[[noreturn]] void refuse_damaged(const std::string& path) {
  throw Error(ExitCode::bad_data,
              path +
                  " is not what talus wrote; its runs are not affected: begin another ensemble from its "
                  "scenario, and move them there");
}

std::vector<std::uint64_t> sorted(std::vector<std::uint64_t> seeds) {
  std::ranges::sort(seeds);
  seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
  return seeds;
}

/// The scenario of a variant, which must be the text of this hash.
Variant read_variant(const std::string& folder, const std::string& name, const std::string& hash) {
  const std::string path = scenario_path(folder, name);
  const std::string text = read_text(path);
  if (hash_of(text) != hash)
    throw Error(ExitCode::bad_data,
                path +
                    " was changed since the ensemble began; expected the scenario that it was made with: "
                    "undo the change, or begin another ensemble with it");
  return {name, path, parse_scenario(text, path)};
}

/// Adds what a line of the manifest says.
void take_line(EnsembleManifest& manifest, const std::string& folder, const std::string& line) {
  const std::size_t blank = std::min(line.find(' '), line.size());
  const std::string kind = line.substr(0, blank), rest = line.substr(std::min(blank + 1, line.size()));
  if (kind == "version") manifest.version = rest;
  if (kind == "seeds") manifest.seeds = parse_seeds(rest);
  if (kind == "until") manifest.until = rest;
  if (kind == "task") manifest.task = parse_task(rest, manifest_path(folder));
  if (kind == "keep") manifest.keep = rest;
  if (kind != "variant") return;
  const std::size_t end = std::min(rest.find(' '), rest.size());
  const std::string name = rest.substr(std::min(end + 1, rest.size()));
  manifest.variants.push_back(read_variant(folder, name, rest.substr(0, end)));
}

const Variant* variant_called(const EnsembleManifest& manifest, const std::string& name) {
  const auto found = std::ranges::find(manifest.variants, name, &Variant::name);
  return found == manifest.variants.end() ? nullptr : &*found;
}

std::string shown(const MemberTask& task) {
  const std::string text = task_text(task);
  return text.empty() ? "no task beside their analysis" : fmt::format("the task '{}'", text);
}

void require_same(const EnsembleManifest& found, const EnsembleManifest& wanted, const std::string& folder) {
  if (found.task != wanted.task)
    throw Error(ExitCode::bad_data,
                fmt::format("{} holds an ensemble whose members have {}, expected {}; give another folder",
                            folder, shown(found.task), shown(wanted.task)));
  bool common = false;
  for (const Variant& variant : wanted.variants) {
    const Variant* there = variant_called(found, variant.name);
    if (there == nullptr) continue;
    common = true;
    if (there->scenario != variant.scenario)
      throw Error(ExitCode::bad_data,
                  fmt::format("{} holds an ensemble of another scenario: {}; give another folder", folder,
                              differences(there->scenario, variant.scenario)));
  }
  if (!common)
    throw Error(ExitCode::bad_data,
                fmt::format("{} holds an ensemble with other variants, {} among them; repeat its --vary with "
                            "more values, or give another folder",
                            folder,
                            found.variants.front().name.empty() ? "the scenario as it is"
                                                                : found.variants.front().name));
}

/// `base` with each value of an axis in turn.
std::vector<std::vector<std::string>> combined(const std::vector<std::vector<std::string>>& base,
                                               const std::vector<std::vector<std::string>>& axis) {
  std::vector<std::vector<std::string>> all;
  for (const std::vector<std::string>& before : base)
    for (const std::vector<std::string>& value : axis) {
      all.push_back(before);
      all.back().insert(all.back().end(), value.begin(), value.end());
    }
  return all;
}

}  // namespace

std::string manifest_path(const std::string& folder) {
  return (fs::path(folder) / ensemble_manifest_name).string();
}

bool is_ensemble(const std::string& folder) {
  std::error_code unknown;
  return fs::exists(manifest_path(folder), unknown);
}

EnsemblePlan plan_of(const EnsembleManifest& manifest, const std::string& folder) {
  return plan_ensemble(manifest.seeds, manifest.variants, folder);
}

EnsembleManifest read_ensemble(const std::string& folder) {
  const std::string path = manifest_path(folder);
  if (!is_ensemble(folder))
    throw Error(
        ExitCode::missing_input,
        fmt::format("{}: no ensemble here; begin one with: talus ensemble SCENARIO --seeds 1-50 -o {}",
                    folder, shell_quoted(folder)));
  const std::string text = read_text(path);
  const std::size_t seal = text.rfind("hash ");
  if (!text.starts_with(first_line) || seal == std::string::npos ||
      text.substr(seal) != fmt::format("hash {}\n", hash_of(text.substr(0, seal))))
    refuse_damaged(path);
  EnsembleManifest manifest;
  std::istringstream lines = text_stream(text.substr(0, seal));
  for (std::string line; std::getline(lines, line);) take_line(manifest, folder, line);
  if (manifest.seeds.empty() || manifest.variants.empty()) refuse_damaged(path);
  return manifest;
}

std::vector<Variant> plan_variants(const std::string& scenario_file, const std::vector<std::string>& settings,
                                   const std::vector<std::string>& axes) {
  refuse_no_scenario(scenario_file);
  std::vector<std::vector<std::string>> combinations = {{}};
  for (const std::string& axis : axes) combinations = combined(combinations, parse_axis(axis));
  std::vector<Variant> variants;
  for (const std::vector<std::string>& combination : combinations) {
    std::vector<std::string> all = settings_without(settings, combination);
    all.push_back("seed=1");
    Scenario scenario = read_scenario(scenario_file, all, nullptr, combination);
    if (!scenario.deposition.file.empty())
      scenario.deposition.file = fs::absolute(scenario.deposition.file).string();
    if (std::ranges::find(variants, scenario, &Variant::scenario) != variants.end()) continue;
    variants.push_back({variation_name(combination, scenario), scenario_file, scenario});
  }
  return variants;
}

EnsembleManifest extend_ensemble(const std::string& folder, const EnsembleManifest& wanted) {
  const std::string lock_path = manifest_path(folder) + ".lock";
  prepare_folder(folder);
  // Only one process at a time extends an ensemble; the others wait.
  const Descriptor lock = create_locked_when_free(lock_path);
  EnsembleManifest all = wanted;
  all.version = version_text();
  all.variants.clear();
  std::string before;
  if (is_ensemble(folder)) {
    before = read_text(manifest_path(folder));
    const EnsembleManifest found = read_ensemble(folder);
    require_same(found, wanted, folder);
    all.version = found.version;
    all.seeds.insert(all.seeds.end(), found.seeds.begin(), found.seeds.end());
    if (wanted.until.empty()) all.until = found.until;
    if (wanted.keep.empty()) all.keep = found.keep;
    all.variants = found.variants;
  }
  all.seeds = parse_seeds(seeds_text(sorted(all.seeds)));  // refuses too many of them
  for (const Variant& variant : wanted.variants) {
    if (variant_called(all, variant.name) != nullptr) continue;
    all.variants.push_back(variant);
    all.variants.back().scenario_file = scenario_path(folder, variant.name);
    prepare_folder_of(all.variants.back().scenario_file);
    write_text(all.variants.back().scenario_file, resolved_toml(variant.scenario));
  }
  for (const Member& member : plan_ensemble({all.seeds.front()}, all.variants, folder).members)
    prepare_folder_of(member.path);
  if (const std::string text = text_of(all); text != before) write_text(manifest_path(folder), text);
  remove_file(lock_path);
  return all;
}

}  // namespace talus
