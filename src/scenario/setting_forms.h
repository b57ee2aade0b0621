#pragma once
/// How people write settings: the forms that are understood beside `section.key=value`, and what is meant by
/// those that are not.

#include <optional>
#include <string>
#include <string_view>

#include "scenario/key.h"

namespace talus::scenario {

/// Without blanks at its ends.
std::string_view trimmed(std::string_view text);

/// A word that may stand for a string without quotes.
bool is_bare_word(std::string_view text);

/// Digits, more of them perhaps than TOML reads.
bool is_whole_number(std::string_view text);

/// The full name of the key that was meant by one that does not exist: written in other letters or with other
/// signs between its words ("Contact.Friction", "contact/friction", "--contact_friction"), or without its
/// section where only one has it. Empty where there is none.
std::string meant_key(const KeyHeads& keys, std::string_view written);

/// The full names of the keys called so, in whichever section.
std::vector<std::string> keys_called(const KeyHeads& keys, std::string_view name);

/// The number that a value is for this key, though TOML does not read it: ".3", "1.", "007", and with the
/// unit of the key behind it, "20 D". Of an integer also "1e5". Nothing for other text and other keys.
std::optional<KeyValue> typed_number(const KeyHead& key, std::string_view value);

/// The end of a message about a setting that has no value, or none that is valid: "; did you mean --set
/// contact.friction=0.3?" for "contact.friction:0.3", and the same for a decimal comma, for a foreign unit,
/// and for two settings in one. Empty where nothing is known. `option`: "--set".
std::string meant_setting(const KeyHeads& keys, const std::string& option, std::string_view setting);

}  // namespace talus::scenario
