#pragma once
/// gnuplot as a program beside this one.

#include <string>

namespace talus::app {

/// Throws Error(unavailable) where gnuplot cannot be started. Ask before long work.
void require_gnuplot();

/// Runs `gnuplot SCRIPT` in a folder. Throws Error(io_error) with what gnuplot said where it gave up.
void run_gnuplot(const std::string& folder, const std::string& script);

}  // namespace talus::app
