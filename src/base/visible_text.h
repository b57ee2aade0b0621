#pragma once
/// Text of a file or of a user, shown on a terminal.

#include <string>
#include <string_view>

namespace talus {

/// The text without anything that a terminal obeys rather than shows: control characters (those of Unicode
/// among them, and what turns the direction of writing) and bytes that are no UTF-8 become \xNN. Lines stay
/// lines.
std::string visible(std::string_view text);

/// A word that a message quotes beside what was expected: in one line, of at most `limit` characters, after
/// which "..." says that there are more, and in ASCII, all else as \xNN: letters that look alike are told
/// apart.
std::string visible_word(std::string_view text, std::size_t limit = 60);

/// The text with U+FFFD in place of each byte that is no UTF-8, which names of files may hold: files and
/// pages are UTF-8.
std::string utf8(std::string_view text);

/// The same in quotes, as JSON and TOML read it: control characters are escaped, so that a terminal shows it
/// as it is.
std::string quoted_utf8(std::string_view text);

/// The length of the UTF-8 character at the beginning of a text that is not empty, in bytes; 0 where there is
/// none.
std::size_t character_length(std::string_view text);

/// Whether a character of UTF-8 is one that a terminal obeys.
bool is_control(std::string_view character);

}  // namespace talus
