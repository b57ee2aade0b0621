#pragma once
/// Suggestions for a mistyped name.

#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// Returns the smallest number of insertions, deletions and replacements of single characters that turn `a`
/// into `b` (Levenshtein).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// Returns the name that a word was probably meant to be, regardless of case: a name that differs by a typing
/// error, begins with the word, or is its beginning. Empty if no name qualifies.
std::string nearest_word(std::string_view written, const std::vector<std::string>& names);

/// Returns the end of a message about an unknown word, such as "; did you mean 'gamma'?", or nothing.
std::string did_you_mean(std::string_view written, const std::vector<std::string>& names);

/// Returns the names of entries that have a member `name`.
template <typename Entries>
std::vector<std::string> names_of(const Entries& entries) {
  std::vector<std::string> names;
  for (const auto& entry : entries) names.emplace_back(entry.name);
  return names;
}

}  // namespace talus
