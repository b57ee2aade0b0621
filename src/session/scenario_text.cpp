#include "session/scenario_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace talus {
namespace {

/// A basic string of TOML.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    std::array<char, 8> escape = {c};
    if (c == '"' || c == '\\') std::snprintf(escape.data(), escape.size(), "\\%c", c);
    if (byte < 0x20 || byte == 0x7f) std::snprintf(escape.data(), escape.size(), "\\u%04x", byte);
    result += escape.data();
  }
  return result + "\"";
}

std::string comment(const ScenarioKey& key) {
  return "# " + (key.unit.empty() ? "" : key.unit + "; ") + key.help;
}

struct Line {
  std::string setting;
  std::string comment;
};

/// Lines of one section, with their comments one below the other.
std::string aligned(const std::vector<Line>& lines) {
  std::size_t width = 0;
  for (const Line& line : lines) width = std::max(width, line.setting.size());
  std::string text;
  for (const Line& line : lines)
    text += line.setting + std::string(width - line.setting.size() + 2, ' ') + line.comment + "\n";
  return text;
}

}  // namespace

std::string short_text(double value) {
  // 100000 reads better than 1e+05, though it is longer.
  const bool plain = value == 0.0 || (std::abs(value) >= 1e-4 && std::abs(value) < 1e7);
  std::array<char, 32> digits;
  char* const last = digits.data() + digits.size();
  const auto end = plain ? std::to_chars(digits.data(), last, value, std::chars_format::fixed).ptr
                         : std::to_chars(digits.data(), last, value).ptr;
  return {digits.data(), end};
}

std::string toml_text(const ScenarioValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return std::to_string(*whole);
  if (const auto* text = std::get_if<std::string>(&value)) return quoted(*text);
  // Without a point or an exponent (and for nan and inf, which have an "n") TOML would read an integer.
  const std::string digits = short_text(std::get<double>(value));
  return digits.find_first_of(".en") == std::string::npos ? digits + ".0" : digits;
}

std::string printable(std::string_view text, std::size_t limit) {
  std::string shown;
  for (const char c : text.substr(0, limit)) {
    std::array<char, 8> escape = {c};
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte > 0x7e) std::snprintf(escape.data(), escape.size(), "\\x%02x", byte);
    shown += escape.data();
  }
  return text.size() > limit ? shown + "..." : shown;
}

std::string resolved_toml(const Scenario& scenario) {
  std::string text;
  std::string section;
  std::vector<Line> lines;
  for (const ScenarioKey& key : scenario_keys()) {
    if (key.section != section) {
      text += aligned(lines) + "\n[" + key.section + "]\n";
      lines.clear();
      section = key.section;
    }
    lines.push_back({key.name + " = " + toml_text(key.get(scenario)), comment(key)});
  }
  return text + aligned(lines);
}

}  // namespace talus
