#pragma once
/// Texts that are made in several places.

#include <fmt/core.h>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>

namespace talus {

/// The items one after the other, or what `text_of` makes of each, with `between` between them.
template <typename Items, typename TextOf = std::identity>
std::string joined(const Items& items, std::string_view between, const TextOf& text_of = {}) {
  std::string text;
  const auto begin = std::begin(items);
  for (auto item = begin; item != std::end(items); ++item)
    text += fmt::format("{}{}", item == begin ? "" : between, std::invoke(text_of, *item));
  return text;
}

/// A field of CSV in quotes (RFC 4180), for texts that may hold commas.
std::string csv_quoted(const std::string& text);

/// A text between the tags of XML, SVG or HTML: <, > and & as entities.
std::string xml_text(std::string_view text);

/// A word as a shell reads it: in quotes where it has to be, and as $'...' of bash with \xNN for bytes that
/// are no text or that a terminal obeys.
std::string shell_quoted(const std::string& word);

}  // namespace talus
