#pragma once
/// The sources of a page, assets/page, which are part of the binary.

#include <string>
#include <string_view>

namespace talus::exports {

/// The document, with {{name}} where something is put in.
std::string_view page_template();
std::string_view page_style();
/// All scripts, one after the other, as one function that keeps its names to itself.
std::string page_script();

/// The template with each {{name}} replaced by what `value_of` gives for it.
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
