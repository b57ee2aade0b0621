#include "app/json.h"

#include <cmath>
#include <fmt/core.h>

#include "base/text.h"
#include "base/visible_text.h"
#include "scenario/text.h"

namespace talus::app {

std::string json_text(const Json& value, std::size_t depth) {
  if (value.is_array())
    return fmt::format("[{}]", joined(value, ", ", [&](const Json& item) { return json_text(item, depth); }));
  if (value.is_object()) {
    const std::string margin(2 * depth, ' ');
    std::string text = "{";
    for (const auto& [name, member] : value.items())
      text += fmt::format("{}\n{}  {}: {}", text.size() > 1 ? "," : "", margin, quoted_utf8(name),
                          json_text(member, depth + 1));
    return fmt::format("{}\n{}}}", text, margin);
  }
  if (value.is_string()) return quoted_utf8(value.get_ref<const std::string&>());
  if (value.is_number_float())
    return std::isfinite(value.get<double>()) ? scenario::short_text(value.get<double>()) : "null";
  return value.dump();
}

}  // namespace talus::app
