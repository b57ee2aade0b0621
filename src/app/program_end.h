#pragma once
/// How the program ends when something goes wrong or it is stopped: a message and an exit code, also where
/// main has no say.

namespace talus::app {

/// Reports the exception under way on stderr, and returns its exit code.
int report_exception();

}  // namespace talus::app
