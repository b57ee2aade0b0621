#pragma once
/// Output of text to the terminal; no other file writes to it.

#include <string_view>

namespace talus::app {

/// Prints as std::printf does, to stdout or stderr, without terminal control characters, which names, keys
/// and texts of files may contain (visible_text.h). The format itself must not contain any.
[[gnu::format(printf, 1, 2)]] void print(const char* format, ...);
[[gnu::format(printf, 1, 2)]] void print_error(const char* format, ...);

/// Prints a text without formatting.
void print_text(std::string_view text);

/// Prints progress on stderr, in place of the last line if `rewrite`.
void print_status(std::string_view line, bool rewrite);

}  // namespace talus::app
