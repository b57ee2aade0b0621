#include "session/scenario_suggestion.h"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <optional>
#include <vector>

#include "session/scenario_keys.h"

namespace talus {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// Edit distance without regard to case; nothing where it is too large for a slip of the pen.
std::optional<std::size_t> slip(std::string_view written, std::string_view existing) {
  // No name is this long, and the cost of comparing grows with the length.
  if (written.size() > 100) return std::nullopt;
  const std::size_t distance = edit_distance(lower(written), existing);
  const std::size_t most = std::max<std::size_t>(2, existing.size() / 3);
  return distance <= most ? std::optional(distance) : std::nullopt;
}

std::string place_of(const std::string& section) {
  return section.empty() ? "the top of the file, above the first section" : "[" + section + "]";
}

std::string joined(const std::vector<std::string>& items, const std::string& between) {
  std::string text;
  for (const std::string& item : items) text += (text.empty() ? "" : between) + item;
  return text;
}

std::vector<std::string> sections() {
  std::vector<std::string> names;
  for (const ScenarioKey& key : scenario_keys())
    if (!key.section.empty() && (names.empty() || names.back() != key.section)) names.push_back(key.section);
  return names;
}

/// The key nearest in name, one of the same section before others; nullptr where none is near. Names of
/// other sections must be nearer: `speed` in [tilt] does not mean the seed.
const ScenarioKey* nearest_key(std::string_view section, std::string_view name) {
  const ScenarioKey* best = nullptr;
  std::size_t least = 0;
  for (const ScenarioKey& key : scenario_keys()) {
    const auto distance = slip(name, key.name);
    const bool elsewhere = key.section != section;
    if (!distance || (elsewhere && !section.empty() && 4 * *distance >= key.name.size())) continue;
    const std::size_t cost = 2 * *distance + (elsewhere ? 1 : 0);
    if (best != nullptr && cost >= least) continue;
    best = &key;
    least = cost;
  }
  return best;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);  // distances of a prefix of a to every prefix of b
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, diagonal + 1, replaced});
    }
  }
  return row.back();
}

std::string suggest_key(std::string_view section, std::string_view name) {
  std::vector<std::string> homes, siblings;
  for (const ScenarioKey& key : scenario_keys()) {
    if (key.name == name) homes.push_back(place_of(key.section));
    if (key.section == section) siblings.push_back(key.name);
  }
  if (!homes.empty()) return "; '" + std::string(name) + "' belongs to " + joined(homes, " or ");
  if (const ScenarioKey* key = nearest_key(section, name)) return "; did you mean '" + full_name(*key) + "'?";
  if (section.empty()) return "; expected seed, or a section: [" + joined(sections(), "], [") + "]";
  return "; [" + std::string(section) + "] has " + joined(siblings, ", ");
}

std::string suggest_section(std::string_view section) {
  std::string best;
  std::size_t least = 0;
  for (const std::string& name : sections()) {
    const auto distance = slip(section, name);
    if (!distance || (!best.empty() && *distance >= least)) continue;
    best = name;
    least = *distance;
  }
  if (!best.empty()) return "; did you mean [" + best + "]?";
  return "; expected one of [" + joined(sections(), "], [") + "]";
}

}  // namespace talus
