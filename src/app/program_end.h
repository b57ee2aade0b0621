#pragma once
/// End of the program on errors and stop requests: a message and an exit code, even outside of main.

namespace talus::app {

/// Reports the current exception on stderr, and returns its exit code.
int report_exception();

}  // namespace talus::app
