#pragma once
/// How this program was called.

#include <string>

namespace talus::app {

/// `talus figures runs/a.h5 -o 'my figures'`: as a shell reads it, for provenance.
std::string command_line();

}  // namespace talus::app
