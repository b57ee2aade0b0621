#pragma once
/// gnuplot as a child process.

#include <string>

namespace talus::app {

/// Throws Error(unavailable) if gnuplot cannot be started. Call before long work.
void require_gnuplot();

/// Runs `gnuplot SCRIPT` in a folder. Throws Error(io_error) with the message of gnuplot if it fails.
void run_gnuplot(const std::string& folder, const std::string& script);

}  // namespace talus::app
