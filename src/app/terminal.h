#pragma once
/// The only place where text goes to the terminal.

#include <string_view>

namespace talus::app {

/// Print as std::printf does, to stdout or stderr, without anything that a terminal obeys: names, keys and
/// texts of files hold what they like (visible_text.h). A format must hold no such character itself.
[[gnu::format(printf, 1, 2)]] void print(const char* format, ...);
[[gnu::format(printf, 1, 2)]] void print_error(const char* format, ...);

/// The same of a text as it is.
void print_text(std::string_view text);

/// On stderr, in place of the line that was shown last if `rewrite`: progress.
void print_status(std::string_view line, bool rewrite);

}  // namespace talus::app
