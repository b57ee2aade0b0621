#pragma once
/// Text from a file or a user, made safe for a terminal.

#include <string>
#include <string_view>

namespace talus {

/// Returns the text without terminal controls: control characters (including those of Unicode and those that
/// change the direction of writing) and bytes that are not UTF-8 become \xNN. Line ends are kept.
std::string visible(std::string_view text);

/// Returns a word for a message that quotes it next to the expected one: on one line, with at most `limit`
/// characters and "..." if there are more, and in ASCII with all other bytes as \xNN, so that letters that
/// look alike can be distinguished.
std::string visible_word(std::string_view text, std::size_t limit = 60);

/// Returns the text with U+FFFD in place of each byte that is not UTF-8. Names of files may contain such
/// bytes; files and pages are UTF-8.
std::string utf8(std::string_view text);

/// Returns the UTF-8 text in quotes, as JSON and TOML read it. Control characters are escaped, so that it is
/// safe for a terminal.
std::string quoted_utf8(std::string_view text);

/// Returns the length in bytes of the UTF-8 character at the beginning of a text that is not empty; 0 if the
/// bytes are not UTF-8.
std::size_t character_length(std::string_view text);

/// Whether a UTF-8 character controls a terminal.
bool is_control(std::string_view character);

}  // namespace talus
