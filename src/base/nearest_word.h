#pragma once
/// "Did you mean": the name that a word was meant to be.

#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// The least number of insertions, deletions and replacements of single characters that turn `a` into `b`
/// (Levenshtein).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The one of some names that a word was meant to be, regardless of case: a slip of the hand away, its
/// beginning, or the name and more. Empty where there is none.
std::string nearest_word(std::string_view written, const std::vector<std::string>& names);

/// The end of a message about a word that is none of these names: "; did you mean 'gamma'?", or nothing.
std::string did_you_mean(std::string_view written, const std::vector<std::string>& names);

/// The names of a table of entries that have a name.
template <typename Entries>
std::vector<std::string> names_of(const Entries& entries) {
  std::vector<std::string> names;
  for (const auto& entry : entries) names.emplace_back(entry.name);
  return names;
}

}  // namespace talus
