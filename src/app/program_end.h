#pragma once
/// How the program ends when something goes wrong: a message and an exit code, also where main has no say.

namespace talus {

/// Tells the exception under way on stderr, and returns its exit code.
int report_exception();

}  // namespace talus
