#pragma once
/// Compact JSON for a page, whose numbers have as many digits as are drawn.

#include <cmath>
#include <concepts>
#include <fmt/core.h>
#include <string>
#include <utility>
#include <vector>

#include "base/text.h"
#include "base/visible_text.h"
#include "scenario/text.h"

namespace talus::exports::json {

/// Names with values that are already JSON, in writing order.
using Members = std::vector<std::pair<std::string, std::string>>;

/// Returns a quoted text.
inline std::string quoted(const std::string& text) { return quoted_utf8(text); }

/// Returns the shortest digits that read back as the same number; null if the value is not finite.
inline std::string number(double value) {
  return std::isfinite(value) ? scenario::short_text(value) : "null";
}
inline std::string truth(bool value) { return value ? "true" : "false"; }
inline std::string number(std::integral auto value) { return std::to_string(value); }

/// Returns { "name": value, ... } with one member per line, at nesting level `depth`.
inline std::string object(const Members& members, int depth = 0) {
  const std::string margin(2 * static_cast<std::size_t>(depth), ' ');
  std::string text = "{";
  for (const auto& [name, value] : members)
    text += fmt::format("{}{}  {}: {}", text.size() > 1 ? ",\n" : "\n", margin, quoted(name), value);
  return fmt::format("{}\n{}}}", text, margin);
}

/// Returns {"name": value, ...} on one line.
inline std::string line(const Members& members) {
  return fmt::format("{{{}}}", joined(members, ",", [](const auto& member) {
                       return fmt::format("{}:{}", quoted(member.first), member.second);
                     }));
}

/// Returns a list, on one line, of values that are already JSON.
inline std::string list(const std::vector<std::string>& values) {
  return fmt::format("[{}]", joined(values, ","));
}

/// Returns a list of numbers with `digits` significant digits, on one line; null if not finite.
inline std::string rounded(const std::vector<double>& values, int digits) {
  return fmt::format("[{}]", joined(values, ",", [digits](double value) {
                       return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "null";
                     }));
}

/// Returns [ "text", ... ].
inline std::string array(const std::vector<std::string>& texts) {
  return fmt::format("[{}]", joined(texts, ", ", quoted));
}

}  // namespace talus::exports::json
