#pragma once
/// What a file manager and a window manager say to a window, which xdotool cannot.

#include <string>

namespace talus::test {

/// Drops a file on a window, by the XDND protocol; `window` as xdotool names it. False where the window does
/// not take it within five seconds.
bool drop_file(const std::string& window, const std::string& path);

/// Asks a window to close, as its button does.
void ask_to_close(const std::string& window);

}  // namespace talus::test
