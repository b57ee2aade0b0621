#pragma once
/// Values as JSON text.

#include <cmath>
#include <concepts>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "session/scenario_text.h"

namespace talus::json {

/// Names and values that are JSON already, in writing order.
using Members = std::vector<std::pair<std::string, std::string>>;

/// `text` in quotes. Bytes above 0x7f are left as they are: UTF-8 stays UTF-8.
inline std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    char escape[8] = {c, '\0'};
    if (c == '"' || c == '\\') std::snprintf(escape, sizeof escape, "\\%c", c);
    if (code < 0x20) std::snprintf(escape, sizeof escape, "\\u%04x", code);
    result += escape;
  }
  return result + "\"";
}

/// The shortest digits that read back as the same number; null where the value is none.
inline std::string number(double value) { return std::isfinite(value) ? short_text(value) : "null"; }
inline std::string truth(bool value) { return value ? "true" : "false"; }
inline std::string number(std::integral auto value) { return std::to_string(value); }

/// { "name": value, ... }, one member a line, `depth` levels deep.
inline std::string object(const Members& members, int depth = 0) {
  const std::string margin(2 * static_cast<std::size_t>(depth), ' ');
  std::string text = "{";
  for (const auto& [name, value] : members)
    text += (text.size() > 1 ? ",\n" : "\n") + margin + "  " + quoted(name) + ": " + value;
  return text + "\n" + margin + "}";
}

/// [ "text", ... ]
inline std::string array(const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) list.append(list.empty() ? "" : ", ").append(quoted(text));
  return "[" + list + "]";
}

}  // namespace talus::json
