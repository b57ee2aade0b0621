#include "scenario/suggestion.h"

#include <algorithm>
#include <cctype>
#include <fmt/core.h>
#include <optional>
#include <vector>

#include "base/nearest_word.h"
#include "base/text.h"
#include "base/visible_text.h"
#include "scenario/setting_forms.h"

namespace talus::scenario {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// Returns the case-insensitive edit distance; empty if it is too large for a typing error.
std::optional<std::size_t> slip(std::string_view written, std::string_view existing) {
  // No name is this long, and the cost of the comparison grows with the length.
  if (written.size() > 100) return std::nullopt;
  const std::size_t distance = edit_distance(lower(written), existing);
  const std::size_t most = std::max<std::size_t>(2, existing.size() / 3);
  return distance <= most ? std::optional(distance) : std::nullopt;
}

std::string place_of(const std::string& section) {
  return section.empty() ? "the top of the file, above the first section" : fmt::format("[{}]", section);
}

/// Returns the key with the nearest name, preferably in the same section; nullptr if none is near. Names in
/// other sections must be nearer: `speed` in [tilt] does not mean the seed.
const KeyHead* nearest_key(const KeyHeads& keys, std::string_view section, std::string_view name) {
  const KeyHead* best = nullptr;
  std::size_t least = 0;
  for (const KeyHead* key : keys) {
    const auto distance = slip(name, key->name);
    const bool elsewhere = key->section != section;
    if (!distance || (elsewhere && !section.empty() && 4 * *distance >= key->name.size())) continue;
    const std::size_t cost = 2 * *distance + (elsewhere ? 1 : 0);
    if (best != nullptr && cost >= least) continue;
    best = key;
    least = cost;
  }
  return best;
}

/// Returns the first key of the section of whose name one word, or the beginning, is written with at most one
/// wrong character: `thresold` means threshold_factors. nullptr if there is none.
const KeyHead* key_with_word(const KeyHeads& keys, std::string_view section, std::string_view name) {
  const auto near = [name](std::string_view word) {
    return word.size() > 3 && slip(name, word).value_or(2) < 2;
  };
  for (const KeyHead* key : keys) {
    if (key->section != section) continue;
    for (std::string_view rest = key->name; !rest.empty();) {
      const auto end = std::min(rest.find('_'), rest.size());
      if (near(rest.substr(0, end))) return key;
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  }
  return nullptr;
}

}  // namespace

std::string suggest_key(const KeyHeads& keys, std::string_view section, std::string_view name) {
  std::vector<std::string> homes, siblings;
  for (const KeyHead* key : keys) {
    if (key->name == name) homes.push_back(place_of(key->section));
    if (key->section == section) siblings.push_back(key->name);
  }
  const std::vector<std::string> sections = sections_of(keys);
  if (!homes.empty() && !sections.empty())
    return fmt::format("; '{}' belongs to {}", name, joined(homes, " or "));
  const KeyHead* meant = nearest_key(keys, section, name);
  if (meant == nullptr) meant = key_with_word(keys, section, name);
  if (meant != nullptr) return fmt::format("; did you mean '{}'?", full_name(*meant));
  if (sections.empty()) return fmt::format("; expected one of {}", joined(siblings, ", "));
  if (section.empty())
    return fmt::format("; expected {}, or a section: [{}]", joined(siblings, ", "), joined(sections, "], ["));
  return fmt::format("; [{}] has {}", section, joined(siblings, ", "));
}

std::string suggest_section(const KeyHeads& keys, std::string_view section) {
  std::string best;
  std::size_t least = 0;
  for (const std::string& name : sections_of(keys)) {
    const auto distance = slip(section, name);
    if (!distance || (!best.empty() && *distance >= least)) continue;
    best = name;
    least = *distance;
  }
  if (!best.empty()) return fmt::format("; did you mean [{}]?", best);
  return fmt::format("; expected one of [{}]", joined(sections_of(keys), "], ["));
}

bool is_section(const KeyHeads& keys, std::string_view name) {
  return std::ranges::any_of(
      keys, [&](const KeyHead* key) { return !key->section.empty() && key->section == name; });
}

std::string joined_name(std::string_view section, std::string_view name) {
  return section.empty() ? std::string(name) : fmt::format("{}.{}", section, name);
}

std::string unknown_key(const KeyHeads& keys, std::string_view section, std::string_view name) {
  return fmt::format("unknown key '{}'{}", visible_word(joined_name(section, name)),
                     suggest_key(keys, section, name));
}

std::string unknown_section(const KeyHeads& keys, std::string_view name) {
  return fmt::format("unknown section [{}]{}", visible_word(name), suggest_section(keys, name));
}

std::string unknown_key_of_setting(const KeyHeads& keys, const std::string& name) {
  const std::string meant = meant_key(keys, name);
  if (meant.empty() && name.starts_with("command."))
    return fmt::format(
        "unknown key '{}': expected command.N.KEY with N from 1 to the number of [[command]] tables of the "
        "scenario, and KEY one of at, time, kind, grain, x and y",
        visible_word(name));
  const std::vector<std::string> several = keys_called(keys, name);
  if (!meant.empty() || !several.empty())
    return fmt::format("unknown key '{}'; did you mean '{}'?", visible_word(name),
                       meant.empty() ? joined(several, "' or '") : meant);
  const auto dot = name.find('.');
  const std::string section = name.substr(0, dot == std::string::npos ? 0 : dot);
  const std::string rest = name.substr(dot == std::string::npos ? 0 : dot + 1);
  if (section.empty() || is_section(keys, section)) return unknown_key(keys, section, rest);
  if (!sections_of(keys).empty()) return unknown_section(keys, section);
  return fmt::format("unknown key '{}'{}", visible_word(name), suggest_key(keys, "", rest));
}

}  // namespace talus::scenario
