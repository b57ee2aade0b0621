#pragma once
/// The command line of this process.

#include <string>

namespace talus::app {

/// Returns the command line with shell quoting, e.g. `talus figures runs/a.h5 -o 'my figures'`, for
/// provenance.
std::string command_line();

}  // namespace talus::app
