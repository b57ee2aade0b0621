#pragma once
/// "Did you mean": suggestions for unknown keys and sections.

#include <string>
#include <string_view>

#include "scenario/key.h"

namespace talus::scenario {

/// Returns the end of a message about an unknown key `name` in `section` (which exists; empty above the first
/// one): "; did you mean 'contact.friction'?", "; 'friction' belongs to [contact]", or the keys of the
/// section.
std::string suggest_key(const KeyHeads& keys, std::string_view section, std::string_view name);

/// Returns the same for an unknown section.
std::string suggest_section(const KeyHeads& keys, std::string_view section);

/// Whether a section with this name exists.
bool is_section(const KeyHeads& keys, std::string_view name);

/// Returns the full name: "contact.friction", or "seed" if the section is empty.
std::string joined_name(std::string_view section, std::string_view name);

/// Return a message about an unknown key, an unknown section, and a setting of the command line with an
/// unknown key.
std::string unknown_key(const KeyHeads& keys, std::string_view section, std::string_view name);
std::string unknown_section(const KeyHeads& keys, std::string_view name);
std::string unknown_key_of_setting(const KeyHeads& keys, const std::string& name);

}  // namespace talus::scenario
