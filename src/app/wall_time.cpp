#include "app/wall_time.h"

#include <cstdio>
#include <fmt/core.h>

#include "base/errors.h"

namespace talus::app {

double parse_wall_time(const std::string& option, const std::string& text) {
  unsigned hours = 0, minutes = 0, seconds = 0;
  int end = 0;
  bool read = std::sscanf(text.c_str(), "%5u:%2u%n:%2u%n", &hours, &minutes, &end, &seconds, &end) >= 2;
  read = read && static_cast<std::size_t>(end) == text.size() &&
         text.find_first_not_of("0123456789:") == std::string::npos;
  const double time = 3600.0 * hours + 60.0 * minutes + seconds;
  if (!read || minutes > 59 || seconds > 59 || time == 0.0)
    throw Error(ExitCode::usage, fmt::format("{} {}: expected HH:MM or HH:MM:SS, more than 0, as in {} 23:30",
                                             option, text, option));
  return time;
}

}  // namespace talus::app
