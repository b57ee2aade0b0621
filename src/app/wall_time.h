#pragma once
/// Wall time as users of batch systems write it.

#include <string>

namespace talus::app {

/// Seconds of "HH:MM" or "HH:MM:SS", more than none. Throws Error(usage), naming `option`.
double parse_wall_time(const std::string& option, const std::string& text);

}  // namespace talus::app
