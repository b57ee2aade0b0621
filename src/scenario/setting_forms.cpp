#include "scenario/setting_forms.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fmt/core.h>

#include "base/visible_text.h"

namespace talus::scenario {
namespace {

/// Returns the letters, in lower case, and the digits of a name.
std::string bare(std::string_view name) {
  std::string letters;
  for (const unsigned char c : name)
    if (std::isalnum(c) != 0) letters += static_cast<char>(std::tolower(c));
  return letters;
}

/// Returns the entire text as a finite number; a leading "+" is accepted.
std::optional<double> number_in(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

/// Returns the end of the number at the beginning of a text; 0 if there is none.
std::size_t end_of_number(std::string_view text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() ? static_cast<std::size_t>(end - text.data()) : 0;
}

bool is_number(const KeyHead& key) {
  return std::holds_alternative<NumberRange>(key.range) || std::holds_alternative<IntegerRange>(key.range);
}

std::string quoted_setting(const std::string& option, std::string_view name, std::string_view value) {
  return fmt::format("{} {}={}", option, name, visible_word(value));
}

/// Suggests a correction for settings such as "contact.friction:0.3" and "contact.friction 0.3".
std::string corrected_separator(const KeyHeads& keys, const std::string& option, std::string_view setting) {
  const std::size_t end = setting.find_first_of(": \t");
  if (end == std::string_view::npos) return {};
  const std::string_view name = setting.substr(0, end), value = trimmed(setting.substr(end + 1));
  if (find_key(keys, name) == nullptr || value.empty()) return {};
  return fmt::format("; did you mean '{}'?", quoted_setting(option, name, value));
}

/// Suggests a correction for two settings in one, such as "contact.friction=0.3,tilt.step=0.002".
std::string joined_settings(const KeyHeads& keys, const std::string& option, const KeyHead& key,
                            std::string_view value) {
  const std::size_t end = value.find_first_of(",; ");
  if (end == std::string_view::npos) return {};
  const std::string_view next = trimmed(value.substr(end + 1));
  const std::size_t equals = next.find('=');
  if (equals == std::string_view::npos || find_key(keys, trimmed(next.substr(0, equals))) == nullptr)
    return {};
  return fmt::format("; did you mean '{} {}'?", quoted_setting(option, full_name(key), value.substr(0, end)),
                     quoted_setting(option, trimmed(next.substr(0, equals)), next.substr(equals + 1)));
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

std::vector<std::string> keys_called(const KeyHeads& keys, std::string_view name) {
  std::vector<std::string> names;
  for (const KeyHead* key : keys)
    if (bare(key->name) == bare(name)) names.push_back(full_name(*key));
  return names;
}

std::string meant_key(const KeyHeads& keys, std::string_view written) {
  if (bare(written).empty()) return {};
  for (const KeyHead* key : keys)
    if (bare(full_name(*key)) == bare(written)) return full_name(*key);
  const std::vector<std::string> called = keys_called(keys, written);
  return called.size() == 1 ? called.front() : "";
}

std::optional<KeyValue> typed_number(const KeyHead& key, std::string_view value) {
  if (!is_number(key)) return std::nullopt;
  if (!key.unit.empty() && value.ends_with(key.unit))
    value = trimmed(value.substr(0, value.size() - key.unit.size()));
  const auto number = number_in(value);
  if (!number || std::holds_alternative<NumberRange>(key.range))
    return number ? std::optional<KeyValue>(*number) : std::nullopt;
  // Smallest double beyond which not every integer is representable.
  constexpr double largest = 9007199254740992.0;
  const bool is_whole = *number == std::floor(*number) && std::abs(*number) < largest;
  return is_whole ? std::optional<KeyValue>(static_cast<std::int64_t>(*number)) : std::nullopt;
}

std::string meant_setting(const KeyHeads& keys, const std::string& option, std::string_view setting) {
  const auto equals = setting.find('=');
  if (equals == std::string_view::npos) return corrected_separator(keys, option, setting);
  const KeyHead* key = find_key(keys, trimmed(setting.substr(0, equals)));
  const std::string_view value = trimmed(setting.substr(equals + 1));
  if (key == nullptr || value.empty()) return {};
  if (std::string two = joined_settings(keys, option, *key, value); !two.empty()) return two;
  std::string other(value);
  std::ranges::replace(other, ',', '.');
  if (value.front() == '=') other.erase(0, 1);
  if (is_number(*key) && other != value && number_in(other))
    return fmt::format("; did you mean '{}'?", quoted_setting(option, full_name(*key), other));
  const std::size_t end = end_of_number(value);
  if (!is_number(*key) || end == 0 || end == value.size()) return {};
  const unsigned char rest = static_cast<unsigned char>(trimmed(value.substr(end)).front());
  if (std::isalpha(rest) == 0 && rest != '%') return {};
  return key->unit.empty() ? "; give the number alone"
                           : fmt::format("; give the number alone, in {}", key->unit);
}

bool is_bare_word(std::string_view text) {
  return !text.empty() &&
         std::ranges::all_of(text, [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; }) &&
         std::isalpha(static_cast<unsigned char>(text.front()));
}

bool is_whole_number(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  return !text.empty() && std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
}

}  // namespace talus::scenario
