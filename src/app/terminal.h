#pragma once
/// Output of text to the terminal; no other file writes to it.

#include <fmt/core.h>
#include <string_view>
#include <utility>

namespace talus::app {

/// Print a text on stdout or stderr, without terminal control characters, which names, keys and texts of
/// files may contain (base/text.h).
void print_text(std::string_view text);
void print_error_text(std::string_view text);

/// Print a text with a format of libfmt.
template <typename... Values>
void print(fmt::format_string<Values...> format, Values&&... values) {
  print_text(fmt::format(format, std::forward<Values>(values)...));
}
template <typename... Values>
void print_error(fmt::format_string<Values...> format, Values&&... values) {
  print_error_text(fmt::format(format, std::forward<Values>(values)...));
}

/// Prints progress on stderr, in place of the last line if `rewrite`.
void print_status(std::string_view line, bool rewrite);

}  // namespace talus::app
