#include "ensemble/ensemble_manifest.h"

#include <algorithm>
#include <cstddef>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "base/errors.h"
#include "base/hash.h"
#include "base/locked_file.h"
#include "base/output_file.h"
#include "base/text.h"
#include "base/version.h"
#include "ensemble/member_results.h"
#include "ensemble/member_state.h"
#include "ensemble/worker.h"
#include "io/durable_file.h"
#include "io/run_folder.h"
#include "io/run_store.h"
#include "session/deposition.h"

namespace talus::ensemble {
namespace {

using Json = nlohmann::ordered_json;  // members keep the order of insertion

constexpr const char* format = "talus ensemble 2";
constexpr std::string_view earlier_line = "talus ensemble 1\n";  // of manifests that were no JSON
constexpr std::string_view seal_key = "\"hash\": ";
constexpr std::size_t max_size = std::size_t{1} << 26;  // bytes, more than any manifest has
constexpr std::size_t longest_name = 255;               // bytes of a folder name

/// Returns DIR/scenarios/contact.friction=0.3.toml, or DIR/scenarios/scenario.toml without a variant.
std::string scenario_path(const std::string& folder, const std::string& variant) {
  const std::string name = variant.empty() ? "scenario" : variant;
  return path_in(path_in(folder, "scenarios"), name + ".toml");
}

/// Formats seeds as "1-3,8", the form that parse_seeds reads.
std::string seeds_text(const std::set<std::uint64_t>& seeds) {
  std::vector<std::string> parts;
  for (auto first = seeds.begin(); first != seeds.end();) {
    auto last = first;
    while (std::next(last) != seeds.end() && *std::next(last) == *last + 1) ++last;
    parts.push_back(first == last ? std::to_string(*first) : fmt::format("{}-{}", *first, *last));
    first = std::next(last);
  }
  return joined(parts, ",");
}

/// Whether a variant name is that of a folder in the folder of the ensemble; the folder itself has no name.
bool is_name_of_folder(const std::string& name) {
  return visible(name) == name && name.find_first_of("\n\t/") == std::string::npos && name != "." &&
         name != ".." && name.size() <= longest_name;
}

/// A manifest as it is read, and the member that is read, for messages: "/variants/3/name".
struct ManifestReader {
  EnsembleManifest manifest = {};
  std::string place = "/";

  std::string text_at(const Json& object, const std::string& parent, const char* key) {
    place = parent + key;
    return object.at(key).get<std::string>();
  }

  void read_variant(const Json& json) {
    const std::string parent = fmt::format("/variants/{}/", manifest.variants.size());
    Variant variant{text_at(json, parent, "name"), "", {}};
    if (!is_name_of_folder(variant.name))
      throw Error(ExitCode::bad_data, "expected a variant whose name is a folder in this one");
    variant.scenario_file = scenario_path("", variant.name);  // "" and "scenario" have the same
    if (std::ranges::find(manifest.variants, variant.scenario_file, &Variant::scenario_file) !=
        manifest.variants.end())
      throw Error(ExitCode::bad_data, "expected unique names");
    if (manifest.variants.size() == max_variants)
      throw Error(ExitCode::bad_data, "expected at most {} variants", max_variants);
    variant.full_name = visible(text_at(json, parent, "full_name"));
    variant.origin = {text_at(json, parent, "scenario"), text_at(json, parent, "bed")};
    manifest.variants.push_back(std::move(variant));
  }

  void read(const Json& json, const std::string& path) {
    if (text_at(json, "/", "format") != format)
      throw Error(ExitCode::bad_data, "expected {}: another version of Talus wrote it", format);
    manifest.version = text_at(json, "/", "version");
    manifest.seeds = parse_seeds(text_at(json, "/", "seeds"));
    if (!(manifest.until = text_at(json, "/", "until")).empty()) parse_precision(manifest.until);
    manifest.task = parse_task(text_at(json, "/", "task"), path);
    check_keep(manifest.keep = text_at(json, "/", "keep"));
    place = "/variants";
    const Json variants = json.value("variants", Json());
    if (!variants.is_array() || variants.empty())
      throw Error(ExitCode::bad_data, "expected a list of variants");
    for (const Json& variant : variants) read_variant(variant);
  }
};

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
                "{} holds an ensemble whose members have {}, expected {}; give another folder", folder,
                shown(found.task), shown(wanted.task));
  bool common = false;
  for (const Variant& variant : wanted.variants) {
    const Variant* there = variant_called(found, variant.name);
    if (there == nullptr) continue;
    common = true;
    if (there->scenario != variant.scenario)
      throw Error(ExitCode::bad_data, "{} holds an ensemble of another scenario: {}; give another folder",
                  folder, scenario::differences(there->scenario, variant.scenario));
  }
  if (!common)
    throw Error(ExitCode::bad_data,
                "{} holds an ensemble with other variants, {} among them; repeat its --vary with more "
                "values, or give another folder",
                folder,
                found.variants.front().name.empty() ? "the unchanged scenario" : found.variants.front().name);
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
  std::vector<Variant>& variants = found.variants;
  const auto failed = std::stable_partition(variants.begin(), variants.end(), [&](const Variant& variant) {
    const Variant* same = variant_called(wanted, variant.name);
    const bool is_wanted = same != nullptr && same->scenario == variant.scenario;
    return is_wanted || !has_only_failures(found, variant, folder);
  });
  std::vector<Variant> removed(failed, variants.end());
  variants.erase(failed, variants.end());
  return removed;
}

/// Frees the names of variants that are no longer in the manifest. The logs of their members, and the results
/// up to their failure, are kept.
void withdraw(const EnsembleManifest& rest, const std::vector<Variant>& withdrawn,
              const std::string& folder) {
  if (rest.variants.empty())
    io::remove_file(manifest_path(folder));
  else
    io::write_text(manifest_path(folder), manifest_text(rest));
  for (const Variant& variant : withdrawn) {
    for (const Member& member : plan_ensemble(rest.seeds, {variant}, folder).members) {
      io::set_withdrawn_aside(member.path);
      io::remove_file(failure_path(member.path));
    }
    io::remove_file(variant.scenario_file);
  }
}

EnsembleManifest extend_locked(const std::string& folder, const EnsembleManifest& wanted) {
  EnsembleManifest all = wanted;
  all.version = version_text();
  all.variants.clear();
  std::set<std::uint64_t> seeds(wanted.seeds.begin(), wanted.seeds.end());
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
      seeds.insert(found.seeds.begin(), found.seeds.end());
      if (wanted.until.empty()) all.until = found.until;
      if (wanted.keep.empty()) all.keep = found.keep;
      all.variants = found.variants;
    }
  }
  all.seeds = parse_seeds(seeds_text(seeds));  // rejects too many seeds
  for (const Variant& variant : wanted.variants) {
    if (variant_called(all, variant.name) != nullptr) continue;
    all.variants.push_back(variant);
    all.variants.back().scenario_file = scenario_path(folder, variant.name);
    prepare_folder_of(all.variants.back().scenario_file);
    const std::string text = scenario::resolved_toml(variant.scenario);
    io::write_text(all.variants.back().scenario_file, text);
    all.variants.back().origin.scenario = text_hash(text);
  }
  for (const Member& member : plan_ensemble({all.seeds.front()}, all.variants, folder).members)
    prepare_folder_of(member.path);
  if (const std::string text = manifest_text(all); text != before)
    io::write_text(manifest_path(folder), text);
  return all;
}

}  // namespace

std::string manifest_path(const std::string& folder) { return path_in(folder, "ensemble.manifest"); }

bool is_ensemble(const std::string& folder) { return is_there(manifest_path(folder)); }

std::string manifest_text(const EnsembleManifest& manifest) {
  Json json = {{"format", format},
               {"version", manifest.version},
               {"seeds", seeds_text({manifest.seeds.begin(), manifest.seeds.end()})},
               {"until", manifest.until},
               {"task", task_text(manifest.task)},
               {"keep", manifest.keep},
               {"variants", Json::array()}};
  for (const Variant& variant : manifest.variants)
    json["variants"].push_back({{"name", variant.name},
                                {"full_name", variant.full_name},
                                {"scenario", variant.origin.scenario},
                                {"bed", variant.origin.bed}});
  std::string text = json.dump(1, ' ', false, Json::error_handler_t::replace);
  text.replace(text.size() - 2, 2, ",\n ");  // instead of the end of the object
  return fmt::format("{}{}\"{}\"\n}}\n", text, seal_key, text_hash(fmt::format("{}{}", text, seal_key)));
}

EnsembleManifest parse_manifest(const std::string& text, const std::string& path) {
  if (text.starts_with(earlier_line))
    throw Error(ExitCode::bad_data, path +
                                        " was written by an earlier revision of Talus; start another "
                                        "ensemble from its scenario, and move the runs there");
  const std::size_t seal = text.rfind(seal_key);
  const std::size_t end = seal == std::string::npos ? 0 : seal + seal_key.size();
  if (end == 0 || text.size() > max_size ||
      text.substr(end) != fmt::format("\"{}\"\n}}\n", text_hash(text.substr(0, end))))
    throw Error(ExitCode::bad_data, path +
                                        " is not what talus wrote; its runs are not affected: start another "
                                        "ensemble from its scenario, and move them there");
  ManifestReader reader;
  const auto refuse = [&](const std::string& place, const std::string& reason) {
    throw Error(ExitCode::bad_data,
                "{}: error at {}: {}; the runs of the ensemble are not affected: start another one from its "
                "scenario, and move them there",
                path, place, reason);
  };
  const auto check_depth = [](int depth, Json::parse_event_t, const Json&) {
    if (depth <= 3) return true;
    throw Error(ExitCode::bad_data, "expected at most three levels of objects and lists");
  };
  try {
    reader.read(Json::parse(text, check_depth), path);
  } catch (const Json::parse_error& error) {
    refuse(fmt::format("byte {}", error.byte), "expected JSON");
  } catch (const Json::exception&) {
    refuse(reader.place, "expected a text");
  } catch (const Error& error) {
    refuse(reader.place, error.what());
  }
  // Members that are unknown, twice, or in another order are not reported one by one.
  if (const std::string written = manifest_text(reader.manifest); written != text) {
    const auto here = std::ranges::mismatch(text, written).in1;
    refuse(fmt::format("line {}", 1 + std::count(text.begin(), here, '\n')),
           "talus does not write this line");
  }
  return std::move(reader.manifest);
}

EnsemblePlan plan_of(const EnsembleManifest& manifest, const std::string& folder) {
  return plan_ensemble(manifest.seeds, manifest.variants, folder);
}

EnsembleManifest read_ensemble(const std::string& folder) {
  const std::string path = manifest_path(folder);
  if (!is_ensemble(folder))
    throw Error(ExitCode::missing_input,
                "{}: no ensemble here; start one with: talus ensemble SCENARIO --seeds 1-50 -o {}", folder,
                shell_quoted(folder));
  EnsembleManifest manifest = parse_manifest(io::read_text(path), path);
  for (Variant& variant : manifest.variants) {
    variant.scenario_file = scenario_path(folder, variant.name);
    const std::string scenario = io::read_text(variant.scenario_file);
    if (text_hash(scenario) != variant.origin.scenario)
      throw Error(ExitCode::bad_data,
                  variant.scenario_file +
                      " has changed since the ensemble was started; expected the original scenario: undo the "
                      "change, or start another ensemble with it");
    variant.scenario = scenario::parse_scenario(scenario, variant.scenario_file);
  }
  return manifest;
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
      throw Error(ExitCode::bad_data,
                  "{} (deposition.file) no longer holds the bed with which the ensemble in {} was started; "
                  "undo the change, give the changed bed another name, or the ensemble another folder",
                  visible(variant.scenario.deposition.file), folder);
  }
}

EnsembleManifest extend_ensemble(const std::string& folder, const EnsembleManifest& wanted) {
  prepare_folder(folder);
  EnsembleManifest all;
  // Only one process at a time extends an ensemble; others wait.
  while_locked(manifest_path(folder) + ".lock", [&] { all = extend_locked(folder, wanted); });
  return all;
}

}  // namespace talus::ensemble
