#include "ensemble/ensemble_manifest.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fmt/core.h>
#include <optional>
#include <span>
#include <sstream>

#include "base/errors.h"
#include "base/hash.h"
#include "base/locked_file.h"
#include "base/output_file.h"
#include "base/paths.h"
#include "base/text.h"
#include "base/text_stream.h"
#include "base/version.h"
#include "base/visible_text.h"
#include "ensemble/axes.h"
#include "ensemble/kept_runs.h"
#include "ensemble/member_state.h"
#include "ensemble/until.h"
#include "io/durable_file.h"
#include "io/mistaken_path.h"
#include "io/run_store.h"
#include "io/writer_lock.h"
#include "session/deposition.h"

namespace talus::ensemble {
namespace {

namespace fs = std::filesystem;

constexpr const char* first_line = "talus ensemble 1";
constexpr std::size_t max_variants = 10000;
constexpr std::size_t longest_name = 255;  // bytes of a folder name

std::string hash_of(const std::string& text) { return hash_text(hash_bytes(std::as_bytes(std::span(text)))); }

/// Returns DIR/scenarios/contact.friction=0.3.toml, or DIR/scenarios/scenario.toml without a variant.
std::string scenario_path(const std::string& folder, const std::string& variant) {
  const std::string name = variant.empty() ? "scenario" : variant;
  return (fs::path(folder) / "scenarios" / (name + ".toml")).string();
}

/// Formats seeds as "1-3,8", the form that parse_seeds reads.
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

/// Returns the text of a manifest. Scenario files that exist are kept, because another version of Talus would
/// write them differently.
std::string text_of(const EnsembleManifest& manifest) {
  std::string text =
      fmt::format("{}\nversion {}\nseeds {}\n", first_line, manifest.version, seeds_text(manifest.seeds));
  if (!manifest.until.empty()) text += fmt::format("until {}\n", manifest.until);
  if (const std::string task = task_text(manifest.task); !task.empty())
    text += fmt::format("task {}\n", task);
  if (!manifest.keep.empty()) text += fmt::format("keep {}\n", manifest.keep);
  for (const Variant& variant : manifest.variants) {
    text += fmt::format("variant {} {}\n", hash_of(io::read_text(variant.scenario_file)), variant.name);
    if (!variant.full_name.empty()) text += fmt::format("full {}\n", variant.full_name);
    if (!variant.origin.bed.empty()) text += fmt::format("bed {}\n", variant.origin.bed);
  }
  return fmt::format("{}hash {}\n", text, hash_of(text));
}

[[noreturn]] void refuse_damaged(const std::string& path) {
  throw Error(ExitCode::bad_data,
              path +
                  " is not what talus wrote; its runs are not affected: start another ensemble from its "
                  "scenario, and move them there");
}

std::vector<std::uint64_t> sorted(std::vector<std::uint64_t> seeds) {
  std::ranges::sort(seeds);
  seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
  return seeds;
}

/// Reads the scenario of a variant, and checks it against its hash.
void read_scenario_of(Variant& variant, const std::string& folder) {
  variant.scenario_file = scenario_path(folder, variant.name);
  const std::string text = io::read_text(variant.scenario_file);
  if (hash_of(text) != variant.origin.scenario)
    throw Error(ExitCode::bad_data,
                variant.scenario_file +
                    " has changed since the ensemble was started; expected the original scenario: "
                    "undo the change, or start another ensemble with it");
  variant.scenario = scenario::parse_scenario(text, variant.scenario_file);
}

/// Whether a variant name lies in the folder of the ensemble. Names of earlier versions have several parts,
/// like paths.
bool is_name_of_folder(const std::string& name) {
  if (name.empty()) return true;  // the folder of the ensemble itself
  const std::vector<std::string> parts = split(name, '/');
  return visible(name) == name && name.find_first_of("\n\t") == std::string::npos &&
         std::ranges::all_of(parts, [](const std::string& part) {
           return !part.empty() && part != "." && part != ".." && part.size() <= longest_name;
         });
}

/// Whether a name would share its folder or its scenario file with another variant.
bool is_there(const EnsembleManifest& manifest, const std::string& name) {
  const std::string path = scenario_path("", name);
  return std::ranges::any_of(manifest.variants, [&](const Variant& variant) {
    return variant.name == name || scenario_path("", variant.name) == path;
  });
}

void take_variant(EnsembleManifest& manifest, const std::string& rest) {
  const std::size_t end = std::min(rest.find(' '), rest.size());
  const std::string name = rest.substr(std::min(end + 1, rest.size()));
  if (!is_name_of_folder(name))
    throw Error(ExitCode::bad_data, "expected a variant whose name is a folder in this one");
  if (is_there(manifest, name)) throw Error(ExitCode::bad_data, "expected unique names");
  if (manifest.variants.size() == max_variants)
    throw Error(ExitCode::bad_data, fmt::format("expected at most {} variants", max_variants));
  manifest.variants.push_back({name, "", {}, "", {rest.substr(0, end), ""}});
}

/// Parses a line of the manifest. Throws Error if talus never writes such a line.
void take_line(EnsembleManifest& manifest, const std::string& folder, const std::string& line) {
  const std::size_t blank = std::min(line.find(' '), line.size());
  const std::string kind = line.substr(0, blank), rest = line.substr(std::min(blank + 1, line.size()));
  static const std::array<std::string, 8> kinds = {"version", "seeds",   "until", "task",
                                                   "keep",    "variant", "full",  "bed"};
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
    throw Error(ExitCode::bad_data, fmt::format("expected one of {}", joined(kinds, ", ")));
  if (kind == "version") manifest.version = rest;
  if (kind == "seeds") manifest.seeds = parse_seeds(rest);
  if (kind == "until") parse_precision(manifest.until = rest);
  if (kind == "task") manifest.task = parse_task(rest, manifest_path(folder));
  if (kind == "keep") check_keep(manifest.keep = rest);
  if (kind == "variant") take_variant(manifest, rest);
  if ((kind == "full" || kind == "bed") && manifest.variants.empty())
    throw Error(ExitCode::bad_data, "expected a preceding line with a variant");
  if (kind == "full") manifest.variants.back().full_name = visible(rest);
  if (kind == "bed") manifest.variants.back().origin.bed = rest;
}

const Variant* variant_called(const EnsembleManifest& manifest, const std::string& name) {
  const auto found = std::ranges::find(manifest.variants, name, &Variant::name);
  return found == manifest.variants.end() ? nullptr : &*found;
}

std::string shown(const MemberTask& task) {
  const std::string text = task_text(task);
  return text.empty() ? "no task in addition to the analysis" : fmt::format("the task '{}'", text);
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
                              scenario::differences(there->scenario, variant.scenario)));
  }
  if (!common)
    throw Error(ExitCode::bad_data,
                fmt::format("{} holds an ensemble with other variants, {} among them; repeat its --vary with "
                            "more values, or give another folder",
                            folder,
                            found.variants.front().name.empty() ? "the unchanged scenario"
                                                                : found.variants.front().name));
}

/// Whether a member failed because of its scenario, rather than a signal or a full disk.
bool has_failed_itself(const Member& member) {
  const auto code = static_cast<ExitCode>(read_failure(member.path).exit_code);
  return code == ExitCode::usage || code == ExitCode::bad_data || code == ExitCode::missing_input ||
         code == ExitCode::internal || code == ExitCode::out_of_memory;
}

/// Whether a variant has only failures: no member has a run, is done or is under way.
bool has_only_failures(const EnsembleManifest& found, const Variant& variant, const std::string& folder) {
  const EnsemblePlan plan = plan_ensemble(found.seeds, {variant}, folder);
  const std::vector<MemberState> states = scan_members(plan);
  bool has_failed = false;
  for (std::size_t m = 0; m < states.size(); ++m) {
    const MemberStage stage = states[m].stage;
    if (stage == MemberStage::done || stage == MemberStage::claimed) return false;
    if (!io::writer_of(io::run_folder(plan.members[m].path)).empty())
      return false;  // it could not be set aside
    if (stage != MemberStage::failed) {
      if (io::run_presence(plan.members[m].path) != io::RunPresence::none) return false;
      continue;
    }
    if (!has_failed_itself(plan.members[m])) return false;
    has_failed = true;
  }
  if (has_failed) return true;
  try {
    session::bed_hash(variant.scenario);
  } catch (const Error&) {
    return true;
  }
  return false;
}

/// Removes unwanted variants with only failures from a manifest, and returns them. They result from a
/// mistaken value, and would keep the ensemble from ever being complete.
std::vector<Variant> remove_failed_variants(EnsembleManifest& found, const EnsembleManifest& wanted,
                                            const std::string& folder) {
  std::vector<Variant> failed_variants, others;
  for (const Variant& variant : found.variants) {
    const bool is_wanted = std::ranges::any_of(wanted.variants, [&](const Variant& other) {
      return other.name == variant.name && other.scenario == variant.scenario;
    });
    (!is_wanted && has_only_failures(found, variant, folder) ? failed_variants : others).push_back(variant);
  }
  found.variants = std::move(others);
  return failed_variants;
}

/// Frees the names of variants that are no longer in the manifest. The logs of their members, and the results
/// up to their failure, are kept.
void withdraw(const EnsembleManifest& rest, const std::vector<Variant>& withdrawn,
              const std::string& folder) {
  if (rest.variants.empty())
    io::remove_file(manifest_path(folder));
  else
    io::write_text(manifest_path(folder), text_of(rest));
  for (const Variant& variant : withdrawn) {
    for (const Member& member : plan_ensemble(rest.seeds, {variant}, folder).members) {
      io::set_withdrawn_aside(member.path);
      io::remove_file(failure_path(member.path));
    }
    io::remove_file(variant.scenario_file);
  }
}

/// Makes a text printable on one line.
std::string in_one_line(const std::string& text) { return joined(split(visible(text), '\n'), "\\x0a"); }

/// Throws Error(usage) for a path that TOML cannot hold; on the command line it may contain any bytes.
void require_path_of_toml(const scenario::Scenario& scenario) {
  try {
    if (scenario::parse_scenario(scenario::resolved_toml(scenario), "scenario") == scenario) return;
  } catch (const Error&) {
    // reported below
  }
  throw Error(
      ExitCode::usage,
      fmt::format("deposition.file = {}: expected a path in UTF-8 of at most 4095 bytes, as a scenario "
                  "file can hold it; rename the file or its folder",
                  visible_word(scenario.deposition.file, 200)));
}

/// Returns `base` combined with each value of an axis.
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
  return (fs::path(folder) / io::ensemble_manifest_name).string();
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
        fmt::format("{}: no ensemble here; start one with: talus ensemble SCENARIO --seeds 1-50 -o {}",
                    folder, shell_quoted(folder)));
  const std::string text = io::read_text(path);
  const std::size_t seal = text.rfind("hash ");
  if (!text.starts_with(first_line) || seal == std::string::npos ||
      text.substr(seal) != fmt::format("hash {}\n", hash_of(text.substr(0, seal))))
    refuse_damaged(path);
  EnsembleManifest manifest;
  std::istringstream lines = text_stream(text.substr(0, seal));
  std::string line;
  std::getline(lines, line);  // skips the first line, which holds the version of the format
  for (int number = 2; std::getline(lines, line); ++number) try {
      take_line(manifest, folder, line);
    } catch (const Error& error) {
      throw LocatedError(
          ExitCode::bad_data,
          fmt::format("{}:{}:1: error: '{}' is not a line that talus writes ({}); the runs of the "
                      "ensemble are not affected: start another one from its scenario, and "
                      "move them there",
                      path, number, visible_word(line), error.what()));
    }
  if (manifest.seeds.empty() || manifest.variants.empty()) refuse_damaged(path);
  for (Variant& variant : manifest.variants) read_scenario_of(variant, folder);
  return manifest;
}

std::vector<Variant> plan_variants(const std::string& scenario_file, const std::vector<std::string>& settings,
                                   const std::vector<std::string>& axes) {
  io::refuse_no_scenario(scenario_file);
  std::vector<std::vector<std::string>> combinations = {{}};
  for (const std::string& axis : axes) {
    const auto values = parse_axis(axis);
    if (combinations.size() * values.size() > max_variants)
      throw Error(ExitCode::usage, fmt::format("--vary: {} combinations of values; expected at most {}",
                                               combinations.size() * values.size(), max_variants));
    combinations = combined(combinations, values);
  }
  std::vector<Variant> variants;
  for (const std::vector<std::string>& combination : combinations) {
    std::vector<std::string> all = settings_without(settings, combination);
    all.push_back("seed=1");
    scenario::Scenario scenario = scenario::read_scenario(scenario_file, all, nullptr, combination);
    if (!scenario.deposition.file.empty()) {
      scenario.deposition.file = absolute_path(scenario.deposition.file);
      require_path_of_toml(scenario);
    }
    if (std::ranges::find(variants, scenario, &Variant::scenario) != variants.end()) continue;
    variants.push_back({folder_name(combination, scenario), scenario_file, scenario});
    if (const std::string name = variation_name(combination, scenario); name != variants.back().name)
      variants.back().full_name = in_one_line(name);
  }
  return variants;
}

std::vector<Variant> plan_one_at_a_time(const std::string& scenario_file,
                                        const std::vector<std::string>& settings,
                                        const std::vector<std::string>& axes) {
  std::vector<Variant> variants = plan_variants(scenario_file, settings, {});
  variants.front().name = "baseline";
  for (const std::string& axis : axes)
    for (Variant& variant : plan_variants(scenario_file, settings, {axis}))
      if (std::ranges::find(variants, variant.scenario, &Variant::scenario) == variants.end())
        variants.push_back(std::move(variant));
  return variants;
}

void take_earlier_names(std::vector<Variant>& variants, const std::string& folder) {
  if (!is_ensemble(folder)) return;
  const EnsembleManifest found = read_ensemble(folder);
  for (const Variant& there : found.variants)
    for (Variant& variant : variants)
      if (there.scenario == variant.scenario) {
        variant.name = there.name;
        variant.full_name = there.full_name;
      }
}

void hash_beds(std::vector<Variant>& variants, const std::string& folder) {
  const EnsembleManifest found = is_ensemble(folder) ? read_ensemble(folder) : EnsembleManifest();
  for (Variant& variant : variants) {
    const Variant* there = variant_called(found, variant.name);
    const bool is_known = there != nullptr && there->scenario == variant.scenario;
    try {
      variant.origin.bed = session::bed_hash(variant.scenario);
    } catch (const Error&) {
      if (!is_known) throw;
      continue;
    }
    if (is_known && !there->origin.bed.empty() && there->origin.bed != variant.origin.bed)
      throw Error(
          ExitCode::bad_data,
          fmt::format("{} (deposition.file) no longer holds the bed with which the ensemble in {} was "
                      "started; undo the change, give the changed bed another name, or the ensemble "
                      "another folder",
                      visible(variant.scenario.deposition.file), folder));
  }
}

namespace {

EnsembleManifest extend_locked(const std::string& folder, const EnsembleManifest& wanted) {
  EnsembleManifest all = wanted;
  all.version = version_text();
  all.variants.clear();
  std::string before;
  if (is_ensemble(folder)) {
    EnsembleManifest found = read_ensemble(folder);
    const std::vector<Variant> failed_variants = remove_failed_variants(found, wanted, folder);
    const bool is_continued = !found.variants.empty();
    if (is_continued) require_same(found, wanted, folder);
    if (!failed_variants.empty()) withdraw(found, failed_variants, folder);
    if (is_continued) {
      before = io::read_text(manifest_path(folder));
      all.version = found.version;
      all.seeds.insert(all.seeds.end(), found.seeds.begin(), found.seeds.end());
      if (wanted.until.empty()) all.until = found.until;
      if (wanted.keep.empty()) all.keep = found.keep;
      all.variants = found.variants;
    }
  }
  all.seeds = parse_seeds(seeds_text(sorted(all.seeds)));  // rejects too many seeds
  for (const Variant& variant : wanted.variants) {
    if (variant_called(all, variant.name) != nullptr) continue;
    all.variants.push_back(variant);
    all.variants.back().scenario_file = scenario_path(folder, variant.name);
    prepare_folder_of(all.variants.back().scenario_file);
    io::write_text(all.variants.back().scenario_file, scenario::resolved_toml(variant.scenario));
  }
  for (const Member& member : plan_ensemble({all.seeds.front()}, all.variants, folder).members)
    prepare_folder_of(member.path);
  if (const std::string text = text_of(all); text != before) io::write_text(manifest_path(folder), text);
  return all;
}

}  // namespace

EnsembleManifest extend_ensemble(const std::string& folder, const EnsembleManifest& wanted) {
  prepare_folder(folder);
  EnsembleManifest all;
  // Only one process at a time extends an ensemble; others wait.
  while_locked(manifest_path(folder) + ".lock", [&] { all = extend_locked(folder, wanted); });
  return all;
}

}  // namespace talus::ensemble
