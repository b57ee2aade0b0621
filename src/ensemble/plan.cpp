#include "ensemble/plan.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <limits>
#include <regex>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "base/errors.h"
#include "base/hash.h"
#include "base/output_file.h"
#include "base/text.h"
#include "io/run_store.h"
#include "scenario/keys.h"
#include "scenario/text.h"
#include "session/estimate.h"

namespace talus::embedded {
// assets/scenarios/paper-*.toml
extern const std::span<const unsigned char> scenario_paper_pbc, scenario_paper_wbc_100,
    scenario_paper_wbc_150, scenario_paper_wbc_200, scenario_paper_wbc_250, scenario_paper_wbc_300;
}  // namespace talus::embedded

namespace talus::ensemble {

constexpr std::size_t max_seeds = 10000;
constexpr std::uint64_t largest_seed = std::numeric_limits<std::int64_t>::max();  // largest TOML integer

[[noreturn]] static void refuse_seeds(const std::string& text) {
  throw Error(ExitCode::usage,
              "--seeds {}: expected seeds such as 1-4, 7 or 1-3,8, at most {}, none above {}",
              visible_word(text), max_seeds, largest_seed);
}

static std::uint64_t parse_seed(const std::string& part, const std::string& text) {
  const auto seed = parse_number<std::uint64_t>(part);
  if (!seed || *seed > largest_seed) refuse_seeds(text);
  return *seed;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
    end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end == std::string::npos ? end : end - begin));
  }
  return parts;
}

std::vector<std::uint64_t> parse_seeds(const std::string& text) {
  std::set<std::uint64_t> seeds;
  for (const std::string& part : split(text, ',')) {
    const std::size_t dash = part.find('-');
    const std::uint64_t first = parse_seed(part.substr(0, dash), text);
    const std::uint64_t last = dash == std::string::npos ? first : parse_seed(part.substr(dash + 1), text);
    if (last < first || last - first >= max_seeds) refuse_seeds(text);
    for (std::uint64_t k = 0; k <= last - first; ++k) seeds.insert(first + k);
    if (seeds.size() > max_seeds) refuse_seeds(text);
  }
  return {seeds.begin(), seeds.end()};
}

EnsemblePlan plan_ensemble(std::vector<std::uint64_t> seeds, std::vector<Variant> variants,
                           const std::string& folder) {
  EnsemblePlan plan{std::move(seeds), std::move(variants), {}};
  for (const std::uint64_t seed : plan.seeds)
    for (std::size_t v = 0; v < plan.variants.size(); ++v) {
      const std::string& parent = plan.variants[v].name;
      const std::string name = fmt::format("{}seed-{}", parent.empty() ? "" : parent + "/", seed);
      const std::string path = path_in(folder, name + ".h5");
      plan.members.push_back({v, seed, name, path, plan.variants[v].scenario, plan.variants[v].origin});
      plan.members.back().scenario.seed = seed;
    }
  return plan;
}

std::vector<double> estimated_seconds(const EnsemblePlan& plan) {
  std::vector<double> seconds;
  for (const Variant& variant : plan.variants) {
    seconds.push_back(0.0);
    try {
      seconds.back() = session::estimate(variant.scenario).seconds;
    } catch (const Error&) {
      continue;  // one bad variant, such as one whose bed file is missing, must not stop the others
    }
  }
  return seconds;
}

std::string path_with_extension(const std::string& path, const char* ending) {
  return std::filesystem::path(path).replace_extension(ending).string();
}

namespace {

[[noreturn]] void refuse_axis(const std::string& text) {
  throw Error(ExitCode::usage,
              "--vary {}: expected KEY=VALUE,VALUE... such as tilt.step=0.002,0.0005, or a range "
              "KEY=FIRST:LAST:STEP; keys that change together are joined by colons, as in "
              "tilt.rate:tilt.step=2:0.002,0.5:0.0005",
              visible_word(text));
}

/// Returns the position after the TOML string whose opening quote is at `begin`; npos if it is not closed.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
  const std::string_view three = text.substr(begin, 3);
  const bool is_long = three == R"(""")" || three == "'''";
  const std::string_view quote = text.substr(begin, is_long ? 3 : 1);
  for (std::size_t at = begin + quote.size(); at < text.size(); ++at) {
    if (quote.front() == '"' && text[at] == '\\')
      ++at;
    else if (text.substr(at).starts_with(quote))
      return at + quote.size();
  }
  return std::string_view::npos;
}

/// Returns the position after an array or an inline table. Whether the brackets match is left to the TOML
/// parser.
std::size_t end_of_bracket(std::string_view text, std::size_t begin) {
  int depth = 0;
  for (std::size_t at = begin; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = end_of_string(text, at);
      continue;
    }
    ++at;
    if (c == '[' || c == '{') ++depth;
    if ((c == ']' || c == '}') && --depth == 0) return at;
  }
  return std::string_view::npos;
}

/// Returns the position after a date with time and optional offset at `begin`; `begin` if there is none.
std::size_t end_of_date(const std::string& text, std::size_t begin) {
  static const std::regex form(
      R"([0-9]{4}-[0-9]{2}-[0-9]{2}[T ]([0-9]{2}:){2}[0-9]{2}[0-9.]{0,20}([+-][0-9]{2}:[0-9]{2})?)");
  std::smatch date;
  const auto first = text.begin() + static_cast<std::ptrdiff_t>(begin);
  std::regex_search(first, text.end(), date, form, std::regex_constants::match_continuous);
  return begin + static_cast<std::size_t>(date.length());  // 0 without a date
}

/// Returns the position of the separator after the value that begins at `begin`, or the end of the text.
std::size_t end_of_value(const std::string& text, std::size_t begin, std::string_view separators) {
  std::size_t at = std::min(text.find_first_not_of(' ', begin), text.size());
  const char first = at < text.size() ? text[at] : '\0';
  const std::size_t opened = at;
  if (first == '"' || first == '\'')
    at = end_of_string(text, at);
  else if (first == '[' || first == '{')
    at = end_of_bracket(text, at);
  else
    at = end_of_date(text, at);
  if (at == std::string::npos)
    throw Error(ExitCode::usage, "--vary {}: expected a closing quote or bracket for the one at {}",
                visible_word(text), visible_word(text.substr(opened), 20));
  return std::min(text.find_first_of(separators, at), text.size());
}

/// Returns the key of a setting: "tilt.step" for "tilt.step=0.002".
std::string key_of_setting(const std::string& setting) {
  return std::string(scenario::trimmed(std::string_view(setting).substr(0, setting.find('='))));
}

/// Returns `settings` without those whose keys the variation sets.
std::vector<std::string> settings_without(std::vector<std::string> settings,
                                          const std::vector<std::string>& variation) {
  for (const std::string& change : variation)
    std::erase_if(settings, [&](const std::string& setting) {
      return key_of_setting(setting) == key_of_setting(change);
    });
  return settings;
}

/// Returns the values that a scenario has for the keys of a variation: "tilt.rate=2,tilt.step=0.002". The
/// spelling is normalised: 1e-6 and 0.000001 are the same variation. Of paths, `short_paths` keeps the last
/// part.
std::string variation_name(const std::vector<std::string>& variation, const scenario::Scenario& scenario,
                           bool short_paths = false) {
  return joined(variation, ",", [&](const std::string& setting) {
    const std::string key = key_of_setting(setting), value = scenario::value_text(scenario, key);
    return fmt::format("{}={}", key, short_paths ? value.substr(value.rfind('/') + 1) : value);
  });
}

/// Whether every file system accepts the character in names and distinguishes it from others; this excludes
/// capitals.
bool is_plain(char c) { return c >= ' ' && c <= '~' && c != '/' && c != '\\' && !(c >= 'A' && c <= 'Z'); }

/// Returns the folder name of a variation. Short plain names are kept. Other names are cut, keep only the
/// last part of a path, and end with a hash of the full name: "deposition.file=dense.csv~0f3c...".
std::string folder_name(const std::vector<std::string>& variation, const scenario::Scenario& scenario) {
  constexpr std::size_t longest = 100, longest_cut = 60;  // bytes
  std::string whole = variation_name(variation, scenario);
  if (whole.size() <= longest && std::ranges::all_of(whole, is_plain)) return whole;
  std::string name = variation_name(variation, scenario, true);
  for (char& c : name)
    if (c < ' ' || c > '~' || c == '\\') c = '_';
  return fmt::format("{}~{}", name.substr(0, longest_cut), text_hash(whole));
}

/// Returns "KEY=0.2,0.3,0.4" for the range "KEY=0.2:0.4:0.1" (first, last, step); any other text as it is.
std::string without_range(const std::string& text, std::size_t equals) {
  std::vector<double> range;
  for (const std::string& part : split(text.substr(equals + 1), ':')) {
    const auto number = parse_number<double>(scenario::trimmed(part));
    if (!number) return text;
    range.push_back(*number);
  }
  if (range.size() != 3) return text;
  const double first = range[0], last = range[1], step = range[2], count = (last - first) / step + 1e-9;
  if (!(step > 0.0 && std::isfinite(first + step) && count >= 0.0 &&
        count < static_cast<double>(max_variants)))
    refuse_axis(text);
  std::string values;
  for (int k = 0; k <= static_cast<int>(count); ++k) {
    const double value = first + k * step;
    values += fmt::format("{}{:.12g}", k > 0 ? "," : "", std::abs(value) < 1e-9 * step ? 0.0 : value);
  }
  return text.substr(0, equals + 1) + values;
}

}  // namespace

std::vector<std::vector<std::string>> parse_axis(const std::string& axis) {
  const std::size_t equals = axis.find('=');
  if (equals == std::string::npos) refuse_axis(axis);
  const std::vector<std::string> keys = split(axis.substr(0, equals), ':');
  const std::string text = keys.size() == 1 ? without_range(axis, equals) : axis;
  const std::string_view separators = keys.size() > 1 ? ",:" : ",";
  std::vector<std::vector<std::string>> variations = {{}};
  for (std::size_t begin = equals + 1;;) {
    const std::size_t end = end_of_value(text, begin, separators);
    const std::string_view value = scenario::trimmed(std::string_view(text).substr(begin, end - begin));
    const std::size_t k = variations.back().size();
    if (k == keys.size() || scenario::trimmed(keys[k]).empty() || value.empty()) refuse_axis(text);
    variations.back().push_back(fmt::format("{}={}", scenario::trimmed(keys[k]), value));
    const bool is_last = end == text.size();
    if ((is_last || text[end] == ',') && variations.back().size() != keys.size()) refuse_axis(text);
    if (is_last) return variations;
    if (text[end] == ',') variations.emplace_back();
    begin = end + 1;
  }
}

constexpr double quick_scale = 0.5;  // factor of lengths and depths

static std::string setting(const char* key, double value) {
  return fmt::format("{}={}", key, scenario::short_text(value));
}

static Variant make_bed(std::string name, const std::string& file, std::span<const unsigned char> bytes,
                        bool quick, std::vector<std::string> settings = {}) {
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (quick) {
    const scenario::Scenario full = scenario::parse_scenario(text, file);
    settings.push_back(setting("bed.length", quick_scale * full.bed.length));
    settings.push_back(setting("bed.depth", quick_scale * full.bed.depth));
  }
  return {std::move(name), file, scenario::parse_scenario(text, file, settings)};
}

std::vector<Variant> paper_beds(bool quick) {
  const auto periodic = [quick](const char* name, std::vector<std::string> settings) {
    return make_bed(name, "paper-pbc.toml", embedded::scenario_paper_pbc, quick, std::move(settings));
  };
  std::vector<Variant> beds = {periodic("pbc", {}),
                               periodic("pbc-geometric", {"deposition.method=geometric"}),
                               periodic("pbc-collapse", {"deposition.method=collapse"})};
  const std::pair<int, const std::span<const unsigned char>&> walls[] = {
      {100, embedded::scenario_paper_wbc_100},
      {150, embedded::scenario_paper_wbc_150},
      {200, embedded::scenario_paper_wbc_200},
      {250, embedded::scenario_paper_wbc_250},
      {300, embedded::scenario_paper_wbc_300}};
  for (const auto& [length, bytes] : walls)
    beds.push_back(make_bed("wbc-" + scenario::short_text((quick ? quick_scale : 1.0) * length),
                            fmt::format("paper-wbc-{}.toml", length), bytes, quick));
  return beds;
}

/// Throws Error(usage) for a path that TOML cannot hold; on the command line it may contain any bytes.
static void require_path_of_toml(const scenario::Scenario& scenario) {
  try {
    if (scenario::parse_scenario(scenario::resolved_toml(scenario), "scenario") == scenario) return;
  } catch (const Error&) {
    // reported below
  }
  throw Error(ExitCode::usage,
              "deposition.file = {}: expected a path in UTF-8 of at most 4095 bytes, as a scenario file can "
              "hold it; rename the file or its folder",
              visible_word(scenario.deposition.file, 200));
}

/// Returns `base` combined with each value of an axis.
static std::vector<std::vector<std::string>> combined(const std::vector<std::vector<std::string>>& base,
                                                      const std::vector<std::vector<std::string>>& axis) {
  std::vector<std::vector<std::string>> all;
  for (const std::vector<std::string>& before : base)
    for (const std::vector<std::string>& value : axis) {
      all.push_back(before);
      all.back().insert(all.back().end(), value.begin(), value.end());
    }
  return all;
}

std::vector<Variant> plan_variants(const std::string& scenario_file, const std::vector<std::string>& settings,
                                   const std::vector<std::string>& axes) {
  io::refuse_no_scenario(scenario_file);
  std::vector<std::vector<std::string>> combinations = {{}};
  for (const std::string& axis : axes) {
    const auto values = parse_axis(axis);
    if (combinations.size() * values.size() > max_variants)
      throw Error(ExitCode::usage, "--vary: {} combinations of values; expected at most {}",
                  combinations.size() * values.size(), max_variants);
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
      variants.back().full_name = joined(split(visible(name), '\n'), "\\x0a");  // printable
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

}  // namespace talus::ensemble
