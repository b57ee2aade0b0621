#pragma once
/// Wall time in the format of batch systems.

#include <string>

namespace talus::app {

/// Returns the seconds of "HH:MM" or "HH:MM:SS", more than 0. Throws Error(usage), naming `option`.
double parse_wall_time(const std::string& option, const std::string& text);

}  // namespace talus::app
