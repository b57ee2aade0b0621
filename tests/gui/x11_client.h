#pragma once
/// Messages of file managers and window managers that xdotool cannot send.

#include <string>

namespace talus::test {

/// Drops a file on a window by the XDND protocol; `window` is the id for xdotool. Returns false if the window
/// does not accept it within five seconds.
bool drop_file(const std::string& window, const std::string& path);

/// Asks a window to close, like its close button.
void ask_to_close(const std::string& window);

}  // namespace talus::test
