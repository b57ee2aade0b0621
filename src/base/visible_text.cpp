#include "base/visible_text.h"

#include <array>
#include <cstdint>
#include <fmt/core.h>

namespace talus {
namespace {

unsigned byte(char c) { return static_cast<unsigned char>(c); }

std::uint32_t code_of(std::string_view character) {
  if (character.size() == 1) return byte(character[0]);
  std::uint32_t code = byte(character[0]) & (0xffu >> (character.size() + 1));
  for (const char c : character.substr(1)) code = code << 6 | (byte(c) & 0x3fu);
  return code;
}

void append_escaped(std::string& shown, std::string_view bytes) {
  for (const char c : bytes) shown += fmt::format("\\x{:02x}", byte(c));
}

}  // namespace

std::size_t character_length(std::string_view text) {
  const unsigned first = byte(text[0]);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  for (const char c : text.substr(1, length - 1))
    if ((byte(c) & 0xc0) != 0x80) return 0;
  // Rejects overlong forms, surrogates of UTF-16, and codes beyond Unicode.
  constexpr std::array<std::uint32_t, 5> least = {0, 0, 0x80, 0x800, 0x10000};
  const std::uint32_t code = code_of(text.substr(0, length));
  return code < least[length] || (code >= 0xd800 && code < 0xe000) || code > 0x10ffff ? 0 : length;
}

bool is_control(std::string_view character) {
  const std::uint32_t code = code_of(character);
  return code < 0x20 || (code >= 0x7f && code < 0xa0) || (code >= 0x200e && code <= 0x200f) ||
         (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
}

namespace {

/// Moves the first character of a text to `shown`, unchanged if `is_shown` accepts it, else escaped.
template <typename Rule>
void move_first(std::string_view& text, std::string& shown, const Rule& is_shown) {
  const std::size_t length = character_length(text);
  const std::string_view character = text.substr(0, length == 0 ? 1 : length);
  if (length > 0 && is_shown(character))
    shown += character;
  else
    append_escaped(shown, character);
  text.remove_prefix(character.size());
}

}  // namespace

std::string utf8(std::string_view text) {
  std::string valid;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    valid += length == 0 ? "\xef\xbf\xbd" : text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return valid;
}

std::string quoted_utf8(std::string_view text) {
  const std::string valid = utf8(text);
  std::string result = "\"";
  for (std::string_view rest = valid; !rest.empty();) {
    const std::string_view character = rest.substr(0, character_length(rest));
    if (is_control(character))
      result += fmt::format("\\u{:04x}", code_of(character));
    else
      result.append(character == "\"" || character == "\\" ? "\\" : "").append(character);
    rest.remove_prefix(character.size());
  }
  return result + "\"";
}

std::string visible(std::string_view text) {
  std::string shown;
  while (!text.empty())
    move_first(text, shown, [](std::string_view c) { return c == "\n" || !is_control(c); });
  return shown;
}

std::string visible_word(std::string_view text, std::size_t limit) {
  std::string shown;
  for (std::size_t count = 0; !text.empty() && count < limit; ++count)
    move_first(text, shown, [](std::string_view c) { return c.size() == 1 && !is_control(c); });
  return text.empty() ? shown : shown + "...";
}

}  // namespace talus
