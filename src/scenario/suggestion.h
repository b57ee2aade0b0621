#pragma once
/// "Did you mean": suggestions for a key or section that does not exist.

#include <string>
#include <string_view>

#include "scenario/key.h"

namespace talus::scenario {

/// The end of a message about an unknown key `name` in `section` (which exists; empty above the first one):
/// "; did you mean 'contact.friction'?", "; 'friction' belongs to [contact]", or what the section has.
std::string suggest_key(const KeyHeads& keys, std::string_view section, std::string_view name);

/// The same for an unknown section.
std::string suggest_section(const KeyHeads& keys, std::string_view section);

bool is_section(const KeyHeads& keys, std::string_view name);

/// "contact.friction"; "seed" where the section is empty.
std::string joined_name(std::string_view section, std::string_view name);

/// A message about a key, about a section, and about a setting of the command line that does not exist.
std::string unknown_key(const KeyHeads& keys, std::string_view section, std::string_view name);
std::string unknown_section(const KeyHeads& keys, std::string_view name);
std::string unknown_key_of_setting(const KeyHeads& keys, const std::string& name);

}  // namespace talus::scenario
