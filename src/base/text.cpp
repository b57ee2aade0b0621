#include "base/text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>

namespace talus {

std::string fixed_text(double value, int decimals) {
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  return text.starts_with('-') && text.find_first_of("123456789n") == std::string::npos ? text.substr(1)
                                                                                        : text;
}

std::string degrees_text(double angle, int decimals) {
  return fixed_text(angle * (180.0 / std::numbers::pi), decimals);
}

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string xml_text(std::string_view text) {
  std::string result;
  for (const char c : text)
    result += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  return result;
}

std::string csv_quoted(const std::string& text) {
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? "\"\"" : std::string(1, c);
  return field + "\"";
}

std::string shell_quoted(const std::string& word) {
  const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./,=:+%@";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  if (visible(word) != word || word.find('\n') != std::string::npos) {
    std::string escaped = "$'";
    for (const char c : word) {
      const auto byte = static_cast<unsigned char>(c);
      if (c == '\'' || c == '\\') escaped += '\\';
      if (byte < 0x20 || byte > 0x7e)
        escaped += fmt::format("\\x{:02x}", byte);
      else
        escaped += c;
    }
    return escaped + "'";
  }
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string base64(std::span<const std::byte> bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) -> std::uint32_t {
      return i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0U;
    };
    const std::uint32_t word = byte(0) << 16U | byte(1) << 8U | byte(2);
    text += digits[word >> 18U];
    text += digits[word >> 12U & 63U];
    text += i + 1 < bytes.size() ? digits[word >> 6U & 63U] : '=';
    text += i + 2 < bytes.size() ? digits[word & 63U] : '=';
  }
  return text;
}

namespace {

unsigned byte(char c) { return static_cast<unsigned char>(c); }

std::uint32_t code_of(std::string_view character) {
  if (character.size() == 1) return byte(character[0]);
  std::uint32_t code = byte(character[0]) & (0xffu >> (character.size() + 1));
  for (const char c : character.substr(1)) code = code << 6 | (byte(c) & 0x3fu);
  return code;
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
    for (const char c : character) shown += fmt::format("\\x{:02x}", byte(c));
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

namespace {

/// Returns the number of characters of a UTF-8 text.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::vector<std::size_t> widths_of(const TextTable& table) {
  std::vector<std::size_t> widths;
  for (const TextColumn& column : table.columns)
    widths.push_back(std::max(width_of(column.title), width_of(column.unit)));
  for (const auto& row : table.rows)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], width_of(row[k].text));
  return widths;
}

std::string padded(const std::string& text, std::size_t width, bool to_the_right) {
  const std::size_t blanks = width - std::min(width, width_of(text));
  return fmt::format("{:{}}{}{:{}}", "", to_the_right ? blanks : 0, text, "", to_the_right ? 0 : blanks);
}

std::string trimmed(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line.append("\n");
}

/// Returns a line of aligned text; `text_of(k)` is the text of column k.
template <typename TextOf>
std::string line_of(const TextTable& table, const std::vector<std::size_t>& widths, std::size_t indent,
                    const TextOf& text_of) {
  std::string line(indent, ' ');
  for (std::size_t k = 0; k < widths.size(); ++k)
    line += fmt::format("{}{}",
                        k == 0                           ? ""
                        : table.columns[k].group.empty() ? "  "
                                                         : " | ",
                        padded(text_of(k), widths[k], table.columns[k].numbers));
  return trimmed(line);
}

/// Returns the line of groups, each at the left edge of its first column.
std::string group_line(const TextTable& table, const std::vector<std::size_t>& widths, std::size_t indent) {
  std::string line;
  std::size_t place = indent;
  for (std::size_t k = 0; k < widths.size(); ++k) {
    const std::string& group = table.columns[k].group;
    if (!group.empty()) line = fmt::format("{} | {}", padded(line, place, false), group);
    place += (k == 0 ? 0 : group.empty() ? 2 : 3) + widths[k];
  }
  return trimmed(line);
}

}  // namespace

std::string number_cell(std::string_view format, double value) {
  if (std::isnan(value)) return "-";
  const std::string text = fmt::format(fmt::runtime(format), value);
  const std::string zero = fmt::format(fmt::runtime(format), 0.0);
  return text.starts_with('-') && text.substr(1) == zero.substr(zero.starts_with('+') ? 1 : 0) ? zero : text;
}

std::string aligned_text(const TextTable& table, std::size_t indent) {
  const std::vector<std::size_t> widths = widths_of(table);
  const std::vector<TextColumn>& columns = table.columns;
  const auto line = [&](const auto& text_of) { return line_of(table, widths, indent, text_of); };
  std::string text;
  if (!std::ranges::all_of(columns, &std::string::empty, &TextColumn::group))
    text += group_line(table, widths, indent);
  text += line([&](std::size_t k) { return columns[k].title; });
  if (!std::ranges::all_of(columns, &std::string::empty, &TextColumn::unit))
    text += line([&](std::size_t k) { return columns[k].unit; });
  for (const auto& row : table.rows)
    text += line([&](std::size_t k) { return k < row.size() ? row[k].text : std::string(); });
  return text;
}

std::string csv_text(const TextTable& table, bool titles) {
  std::string text = titles ? fmt::format("{}\n", joined(table.columns, ",", &TextColumn::title)) : "";
  for (const auto& row : table.rows) text += joined(row, ",", &TextCell::text) + "\n";
  return text;
}

namespace {

constexpr std::size_t longest_name = 100;  // the cost of comparing grows with the length

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// Whether a written word probably means a name. Of a short name little remains after two errors, so the
/// first letter must be right.
bool is_near(const std::string& written, const std::string& name, std::size_t distance) {
  const bool begins = written.size() >= 3 && name.starts_with(written);
  const bool is_extended = name.size() >= 4 && written.starts_with(name);
  if (begins || is_extended) return true;
  if (distance > std::max<std::size_t>(2, name.size() / 3)) return false;
  return distance < 2 || (name.size() > 4 ? distance < written.size() : written.front() == name.front());
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);  // distances of a prefix of a to every prefix of b
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, diagonal + 1, replaced});
    }
  }
  return row.back();
}

std::string nearest_word(std::string_view written, const std::vector<std::string>& names) {
  if (written.size() < 2 || written.size() > longest_name) return {};
  const std::string word = lower(written);
  std::string best;
  std::size_t least = 0;
  for (const std::string& name : names) {
    if (name.empty()) continue;
    const std::size_t distance = edit_distance(word, lower(name));
    if (!is_near(word, lower(name), distance) || (!best.empty() && distance >= least)) continue;
    best = name;
    least = distance;
  }
  return best;
}

std::string did_you_mean(std::string_view written, const std::vector<std::string>& names) {
  const std::string nearest = nearest_word(written, names);
  return nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest);
}

}  // namespace talus
