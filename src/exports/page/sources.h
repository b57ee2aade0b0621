#pragma once
/// The sources of a page, assets/page, which are embedded in the binary.

#include <string>
#include <string_view>

namespace talus::exports {

/// Returns the document, with {{name}} as placeholders.
std::string_view page_template();
std::string_view page_style();
/// Returns all scripts in sequence, wrapped in one function that keeps their names local.
std::string page_script();

/// Returns the template with each {{name}} replaced by value_of(name).
template <typename ValueOf>
std::string filled(std::string_view text, const ValueOf& value_of) {
  std::string result;
  for (auto open = text.find("{{"); open != std::string_view::npos; open = text.find("{{")) {
    const auto close = text.find("}}", open);
    result.append(text.substr(0, open)).append(value_of(text.substr(open + 2, close - open - 2)));
    text.remove_prefix(close + 2);
  }
  return result.append(text);
}

}  // namespace talus::exports
