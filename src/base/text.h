#pragma once
/// Texts: composed, read, encoded, made safe for a terminal, aligned in a table; and suggestions for a
/// mistyped name.

#include <charconv>
#include <cstddef>
#include <fmt/core.h>
#include <functional>
#include <iterator>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

// Text read word by word or line by line.

/// Returns a stream over a text that throws if memory is missing. Other streams only set a bit, as if the
/// text had ended.
inline std::istringstream text_stream(const std::string& text) {
  std::istringstream stream(text);
  stream.exceptions(std::ios::badbit);
  return stream;
}

/// Returns the lines of a text, without their ends.
inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream = text_stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Returns the number that the whole text denotes, as std::from_chars reads it; no value for other text.
template <typename T>
std::optional<T> parse_number(std::string_view text) {
  T number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// Concatenates the items, or text_of(item) of each, with `between` between them.
template <typename Items, typename TextOf = std::identity>
std::string joined(const Items& items, std::string_view between, const TextOf& text_of = {}) {
  std::string text;
  const auto begin = std::begin(items);
  for (auto item = begin; item != std::end(items); ++item)
    text += fmt::format("{}{}", item == begin ? "" : between, std::invoke(text_of, *item));
  return text;
}

/// Returns a number with this many decimals. One that rounds to zero has no sign: "0.00", not "-0.00".
std::string fixed_text(double value, int decimals);
/// Returns an angle (rad) in degrees in this form, without a unit.
std::string degrees_text(double angle, int decimals);
/// Returns a number with a noun whose plural ends with s: "1 frame", "2 frames".
std::string counted(std::size_t count, std::string_view noun);

/// Returns a CSV field in quotes (RFC 4180), for texts that may contain commas.
std::string csv_quoted(const std::string& text);

/// Escapes a text for XML, SVG or HTML: <, > and & become entities.
std::string xml_text(std::string_view text);

/// Quotes a word for a shell if necessary, as $'...' of bash with \xNN if it contains bytes that are not text
/// or that control a terminal.
std::string shell_quoted(const std::string& word);

// Encoding of bytes as text.

/// Encodes bytes in Base64 (RFC 4648), with padding.
std::string base64(std::span<const std::byte> bytes);

// Text from a file or a user, made safe for a terminal.

/// Returns the text without terminal controls: control characters (including those of Unicode and those that
/// change the direction of writing) and bytes that are not UTF-8 become \xNN. Line ends are kept.
std::string visible(std::string_view text);

/// Returns a word for a message that quotes it next to the expected one: on one line, with at most `limit`
/// characters and "..." if there are more, and in ASCII with all other bytes as \xNN, so that letters that
/// look alike can be distinguished.
std::string visible_word(std::string_view text, std::size_t limit = 60);

/// Returns the text with U+FFFD in place of each byte that is not UTF-8. Names of files may contain such
/// bytes; files and pages are UTF-8.
std::string utf8(std::string_view text);

/// Returns the UTF-8 text in quotes, as JSON and TOML read it. Control characters are escaped, so that it is
/// safe for a terminal.
std::string quoted_utf8(std::string_view text);

/// Returns the length in bytes of the UTF-8 character at the beginning of a text that is not empty; 0 if the
/// bytes are not UTF-8.
std::size_t character_length(std::string_view text);

/// Whether a UTF-8 character controls a terminal.
bool is_control(std::string_view character);

// A table of words and numbers as aligned text or CSV.

struct TextCell {
  std::string text;
};

struct TextColumn {
  std::string title;
  bool numbers = false;    ///< whether to align to the right
  std::string unit = {};   ///< unit below the title, in aligned text
  std::string group = {};  ///< heading above this and the following columns without one, in aligned text
};

/// A table. Rows may have fewer cells than the table has columns, and the last column may have no title.
struct TextTable {
  std::vector<TextColumn> columns;
  std::vector<std::vector<TextCell>> rows;
};

/// Formats a number with a format of libfmt, such as "{:.3f}"; "-" for NaN, no minus for 0.
std::string number_cell(std::string_view format, double value);

/// Returns aligned text: columns as wide as their widest cell, two blanks apart, after `indent` blanks, with
/// a bar before each group.
std::string aligned_text(const TextTable& table, std::size_t indent = 0);

/// Returns CSV: a line of titles, if requested, and one line for each row. Texts that may contain commas must
/// be quoted (csv_quoted).
std::string csv_text(const TextTable& table, bool titles = true);

// Suggestions for a mistyped name.

/// Returns the smallest number of insertions, deletions and replacements of single characters that turn `a`
/// into `b` (Levenshtein).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// Returns the name that a word was probably meant to be, regardless of case: a name that differs by a typing
/// error, begins with the word, or is its beginning. Empty if no name qualifies.
std::string nearest_word(std::string_view written, const std::vector<std::string>& names);

/// Returns the end of a message about an unknown word, such as "; did you mean 'gamma'?", or nothing.
std::string did_you_mean(std::string_view written, const std::vector<std::string>& names);

/// Returns the names of entries that have a member `name`.
template <typename Entries>
std::vector<std::string> names_of(const Entries& entries) {
  std::vector<std::string> names;
  for (const auto& entry : entries) names.emplace_back(entry.name);
  return names;
}

}  // namespace talus
