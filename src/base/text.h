#pragma once
/// Functions that compose texts.

#include <cstddef>
#include <fmt/core.h>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>

namespace talus {

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

}  // namespace talus
