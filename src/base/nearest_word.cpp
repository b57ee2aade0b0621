#include "base/nearest_word.h"

#include <algorithm>
#include <cctype>
#include <fmt/core.h>
#include <numeric>

namespace talus {
namespace {

constexpr std::size_t longest_name = 100;  // the cost of comparing grows with the length

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// Whether a written word probably means a name. Of a short name little remains after two errors, so the
/// first letter must be right.
bool is_near(const std::string& written, const std::string& name, std::size_t distance) {
  const bool begins = written.size() >= 3 && name.starts_with(written);
  const bool is_extended = name.size() >= 4 && written.starts_with(name);
  if (begins || is_extended) return true;
  if (distance > std::max<std::size_t>(2, name.size() / 3)) return false;
  return distance < 2 || (name.size() > 4 ? distance < written.size() : written.front() == name.front());
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

std::string nearest_word(std::string_view written, const std::vector<std::string>& names) {
  if (written.size() < 2 || written.size() > longest_name) return {};
  const std::string word = lower(written);
  std::string best;
  std::size_t least = 0;
  for (const std::string& name : names) {
    if (name.empty()) continue;
    const std::size_t distance = edit_distance(word, lower(name));
    if (!is_near(word, lower(name), distance) || (!best.empty() && distance >= least)) continue;
    best = name;
    least = distance;
  }
  return best;
}

std::string did_you_mean(std::string_view written, const std::vector<std::string>& names) {
  const std::string nearest = nearest_word(written, names);
  return nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest);
}

}  // namespace talus
