#include "session/study.h"

#include <algorithm>
#include <charconv>
#include <set>

#include "core/errors.h"
#include "session/scenario_keys.h"
#include "session/scenario_text.h"

namespace talus {
namespace {

constexpr std::size_t most_seeds = 10000;

/// The parts between separators; an empty text has one empty part.
std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
    end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end == std::string::npos ? end : end - begin));
  }
  return parts;
}

[[noreturn]] void refuse_seeds(const std::string& text) {
  throw Error(ExitCode::usage, "--seeds " + printable(text) +
                                   ": expected seeds such as 1-4, 7 or 1-3,8, at most " +
                                   std::to_string(most_seeds));
}

std::uint64_t parse_seed(const std::string& part, const std::string& text) {
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), seed);
  if (error != std::errc() || end != part.data() + part.size()) refuse_seeds(text);
  return seed;
}

[[noreturn]] void refuse_axis(const std::string& text) {
  throw Error(ExitCode::usage, "--vary " + printable(text) +
                                   ": expected KEY=VALUE,VALUE... such as tilt.step=0.002,0.0005; keys that "
                                   "change together are joined by colons, as in "
                                   "tilt.rate:tilt.step=2:0.002,0.5:0.0005");
}

std::string key_of(const std::string& setting) { return setting.substr(0, setting.find('=')); }

/// `settings` with those of the variation instead of their own for the same keys.
std::vector<std::string> changed(std::vector<std::string> settings,
                                 const std::vector<std::string>& variation) {
  for (const std::string& change : variation)
    std::erase_if(settings, [&](const std::string& setting) { return key_of(setting) == key_of(change); });
  settings.insert(settings.end(), variation.begin(), variation.end());
  return settings;
}

std::string plain_text(const ScenarioValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return short_text(*number);
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return toml_text(value);
}

/// The values that a scenario has for the keys of a variation. They are not as they were spelled: 1e-6 and
/// 0.000001 are one variation.
std::string name_of(const std::vector<std::string>& variation, const Scenario& scenario) {
  std::string name;
  for (const std::string& setting : variation) {
    const ScenarioKey* key = find_key(key_of(setting));
    if (!name.empty()) name += ",";
    name += full_name(*key) + "=" + plain_text(key->get(scenario));
  }
  return name;
}

}  // namespace

std::vector<std::uint64_t> parse_seeds(const std::string& text) {
  std::set<std::uint64_t> seeds;
  for (const std::string& part : split(text, ',')) {
    const std::size_t dash = part.find('-');
    const std::uint64_t first = parse_seed(part.substr(0, dash), text);
    const std::uint64_t last = dash == std::string::npos ? first : parse_seed(part.substr(dash + 1), text);
    if (last < first || last - first >= most_seeds) refuse_seeds(text);
    for (std::uint64_t k = 0; k <= last - first; ++k) seeds.insert(first + k);
  }
  if (seeds.size() > most_seeds) refuse_seeds(text);
  return {seeds.begin(), seeds.end()};
}

std::vector<std::vector<std::string>> parse_axis(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) refuse_axis(text);
  const std::vector<std::string> keys = split(text.substr(0, equals), ':');
  std::vector<std::vector<std::string>> variations;
  for (const std::string& item : split(text.substr(equals + 1), ',')) {
    const std::vector<std::string> values = split(item, ':');
    if (values.size() != keys.size()) refuse_axis(text);
    std::vector<std::string> settings;
    for (std::size_t k = 0; k < keys.size(); ++k) {
      if (keys[k].empty() || values[k].empty()) refuse_axis(text);
      settings.push_back(keys[k] + "=" + values[k]);
    }
    variations.push_back(std::move(settings));
  }
  return variations;
}

StudyPlan plan_study(const std::string& scenario_file, const std::vector<std::string>& settings,
                     const std::vector<std::string>& axes, const std::string& seeds) {
  StudyPlan plan;
  plan.scenario_file = scenario_file;
  plan.seeds = parse_seeds(seeds);
  std::vector<Scenario> scenarios;
  std::vector<std::string> varied;
  const auto add = [&](const std::vector<std::string>& variation) {
    const std::vector<std::string> all = changed(settings, variation);
    std::vector<std::string> with_seed = all;
    with_seed.push_back("seed=" + std::to_string(plan.seeds.front()));
    const Scenario scenario = read_scenario(scenario_file, with_seed);
    for (const std::string& setting : variation)
      if (std::ranges::find(varied, key_of(setting)) == varied.end()) varied.push_back(key_of(setting));
    if (std::ranges::find(scenarios, scenario) != scenarios.end()) return;
    scenarios.push_back(scenario);
    plan.variations.push_back({variation.empty() ? "baseline" : name_of(variation, scenario), all});
  };
  add({});
  for (const std::string& axis : axes)
    for (const std::vector<std::string>& variation : parse_axis(axis)) add(variation);
  plan.baseline = name_of(varied, scenarios.front());
  for (const std::uint64_t seed : plan.seeds)
    for (std::size_t v = 0; v < plan.variations.size(); ++v) {
      StudyRun run{v, seed, plan.variations[v].name + "/seed-" + std::to_string(seed), scenarios[v]};
      run.scenario.seed = seed;
      plan.runs.push_back(std::move(run));
    }
  return plan;
}

}  // namespace talus
