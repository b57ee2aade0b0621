#include "scenario/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/core.h>

#include "base/text.h"
#include "scenario/keys.h"
#include "scenario/scripted_command.h"

namespace talus::scenario {
namespace {

std::string comment(const KeyHead& key) {
  return fmt::format("# {}{}", key.unit.empty() ? "" : key.unit + "; ", key.help);
}

struct SettingLine {
  std::string setting;
  std::string comment;
};

/// Returns the lines of one section with aligned comments.
std::string aligned(const std::vector<SettingLine>& lines) {
  std::size_t width = 0;
  for (const SettingLine& line : lines) width = std::max(width, line.setting.size());
  std::string text;
  for (const SettingLine& line : lines)
    text += line.comment.empty()
                ? line.setting + "\n"
                : fmt::format("{}{:{}}{}\n", line.setting, "", width - line.setting.size() + 2, line.comment);
  return text;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

std::string short_text(double value) {
  // 100000 is easier to read than 1e+05, although it is longer.
  const bool plain = value == 0.0 || (std::abs(value) >= 1e-4 && std::abs(value) < 1e7);
  std::array<char, 32> digits;
  char* const last = digits.data() + digits.size();
  const auto end = plain ? std::to_chars(digits.data(), last, value, std::chars_format::fixed).ptr
                         : std::to_chars(digits.data(), last, value).ptr;
  return {digits.data(), end};
}

std::string toml_text(const KeyValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return std::to_string(*whole);
  if (const auto* truth = std::get_if<bool>(&value)) return *truth ? "true" : "false";
  if (const auto* text = std::get_if<std::string>(&value)) return quoted_utf8(*text);
  if (const auto* numbers = std::get_if<std::vector<double>>(&value))
    return fmt::format("[{}]", joined(*numbers, ", ", [](double number) { return toml_text(number); }));
  if (const auto* phrases = std::get_if<std::vector<std::string>>(&value))
    return fmt::format("[{}]", joined(*phrases, ", ", quoted_utf8));
  // TOML would read an integer without a point or an exponent; nan and inf contain an "n".
  const std::string digits = short_text(std::get<double>(value));
  return digits.find_first_of(".en") == std::string::npos ? digits + ".0" : digits;
}

std::string plain_text(const KeyValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return short_text(*number);
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* numbers = std::get_if<std::vector<double>>(&value))
    return joined(*numbers, ",", short_text);
  if (const auto* phrases = std::get_if<std::vector<std::string>>(&value)) return joined(*phrases, ", ");
  return toml_text(value);
}

std::string resolved_toml(const Scenario& scenario) {
  std::string text;
  std::string section;
  std::vector<SettingLine> lines;
  for (const ScenarioKey& key : scenario_keys()) {
    if (key.section != section) {
      text += aligned(lines) + "\n[" + key.section + "]\n";
      lines.clear();
      section = key.section;
    }
    lines.push_back({key.name + " = " + toml_text(key.get(scenario)), comment(key)});
  }
  text += aligned(lines);
  for (const ScriptedCommand& command : scenario.commands) {
    lines.clear();
    for (const CommandKey& key : command_keys()) {
      const bool is_moment = key.name == "at" || key.name == "time";
      const bool is_said = is_moment ? key.get(command) != KeyValue("none")
                                     : key.name == "kind" || takes_key(command.kind, key.name);
      const std::string unit = key.unit.empty() ? "" : "# " + key.unit;
      if (is_said) lines.push_back({key.name + " = " + toml_text(key.get(command)), unit});
    }
    text += "\n[[command]]\n" + aligned(lines);
  }
  return text;
}

std::string differences(const Scenario& there, const Scenario& here) {
  std::vector<std::string> parts;
  for (const std::string& name : key_names(there.commands.size() > here.commands.size() ? there : here))
    if (const std::string was = value_text(there, name), is = value_text(here, name); was != is)
      parts.push_back(fmt::format("{} is {} there, {} here", name, was, is));
  return joined(parts, "; ");
}

}  // namespace talus::scenario
