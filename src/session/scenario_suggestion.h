#pragma once
/// "Did you mean": what a user may have wanted who wrote a key or section that does not exist.

#include <string>
#include <string_view>

namespace talus {

/// Fewest insertions, deletions and replacements of one character that turn `a` into `b` (Levenshtein).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The end of a message about an unknown key `name` in `section` (which exists; empty above the first one):
/// "; did you mean 'contact.friction'?", "; 'friction' belongs to [contact]", or what the section has.
std::string suggest_key(std::string_view section, std::string_view name);

/// The same for an unknown section.
std::string suggest_section(std::string_view section);

}  // namespace talus
