#pragma once
/// Forms of settings: those accepted in addition to `section.key=value`, and suggestions for those that are
/// not.

#include <optional>
#include <string>
#include <string_view>

#include "scenario/key.h"

namespace talus::scenario {

/// Removes blanks at both ends.
std::string_view trimmed(std::string_view text);

/// Whether a word may be used as a string without quotes.
bool is_bare_word(std::string_view text);

/// Whether a text consists of digits, possibly more of them than TOML reads.
bool is_whole_number(std::string_view text);

/// Returns the full name of the existing key that was meant by an unknown one: written with other letters or
/// other separators ("Contact.Friction", "contact/friction", "--contact_friction"), or without its section if
/// only one section has it. Empty if there is none.
std::string meant_key(const KeyHeads& keys, std::string_view written);

/// Returns the full names of all keys with this name, in any section.
std::vector<std::string> keys_called(const KeyHeads& keys, std::string_view name);

/// Returns the number that a value means for this key if TOML does not read it: ".3", "1.", "007", the unit
/// of the key after the number ("20 D"), and for an integer also "1e5". Empty for other text and other keys.
std::optional<KeyValue> typed_number(const KeyHead& key, std::string_view value);

/// Returns the end of a message about a setting without a valid value: "; did you mean --set
/// contact.friction=0.3?" for "contact.friction:0.3", and similarly for a decimal comma, for another unit,
/// and for two settings in one. Empty without a suggestion. `option`: "--set".
std::string meant_setting(const KeyHeads& keys, const std::string& option, std::string_view setting);

}  // namespace talus::scenario
