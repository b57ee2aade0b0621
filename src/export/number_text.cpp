#include "export/number_text.h"

#include <cmath>
#include <cstdint>
#include <fmt/core.h>
#include <iterator>

namespace talus {

void append_number(std::string& text, double value, FieldNumber number, std::string_view nan) {
  if (std::isnan(value))
    text += nan;
  else if (number == FieldNumber::integer)
    fmt::format_to(std::back_inserter(text), "{}", static_cast<std::int64_t>(value));
  else if (number == FieldNumber::single)
    fmt::format_to(std::back_inserter(text), "{}", static_cast<float>(value));
  else
    fmt::format_to(std::back_inserter(text), "{}", value);
}

}  // namespace talus
