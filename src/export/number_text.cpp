#include "export/number_text.h"

#include <cmath>
#include <cstdint>
#include <fmt/core.h>

namespace talus {

void append_number(std::string& text, double value, FieldNumber number, std::string_view nan) {
  if (std::isnan(value))
    text += nan;
  else if (number == FieldNumber::integer)
    text += fmt::format("{}", static_cast<std::int64_t>(value));
  else if (number == FieldNumber::single)
    text += fmt::format("{}", static_cast<float>(value));
  else
    text += fmt::format("{}", value);
}

}  // namespace talus
