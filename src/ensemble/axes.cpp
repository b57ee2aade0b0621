#include "ensemble/axes.h"

#include <algorithm>
#include <fmt/core.h>
#include <functional>
#include <span>
#include <string_view>

#include "base/errors.h"
#include "base/hash.h"
#include "base/visible_text.h"
#include "ensemble/plan.h"
#include "scenario/keys.h"
#include "scenario/setting_forms.h"
#include "scenario/text.h"

namespace talus::ensemble {
namespace {

[[noreturn]] void refuse_axis(const std::string& text) {
  throw Error(
      ExitCode::usage,
      fmt::format("--vary {}: expected KEY=VALUE,VALUE... such as tilt.step=0.002,0.0005; keys that change "
                  "together are joined by colons, as in tilt.rate:tilt.step=2:0.002,0.5:0.0005",
                  visible_word(text)));
}

[[noreturn]] void refuse_open_value(const std::string& text, std::size_t begin) {
  throw Error(ExitCode::usage, fmt::format("--vary {}: expected a closing quote or bracket for the one at {}",
                                           visible_word(text), visible_word(text.substr(begin), 20)));
}

/// Returns the position after the TOML string whose opening quote is at `begin`; npos if it is not closed.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
  const std::string_view three = text.substr(begin, 3);
  const bool is_long = three == R"(""")" || three == "'''";
  const std::string_view quote = text.substr(begin, is_long ? 3 : 1);
  for (std::size_t at = begin + quote.size(); at < text.size(); ++at) {
    if (quote.front() == '"' && text[at] == '\\')
      ++at;
    else if (text.substr(at).starts_with(quote))
      return at + quote.size();
  }
  return std::string_view::npos;
}

/// Returns the position after an array or an inline table. Whether the brackets match is left to the TOML
/// parser.
std::size_t end_of_bracket(std::string_view text, std::size_t begin) {
  int depth = 0;
  for (std::size_t at = begin; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = end_of_string(text, at);
      continue;
    }
    ++at;
    if (c == '[' || c == '{') ++depth;
    if ((c == ']' || c == '}') && --depth == 0) return at;
  }
  return std::string_view::npos;
}

/// Whether a text begins with digits at the zeros of `form`, and with the same characters elsewhere.
bool has_form(std::string_view text, std::string_view form) {
  if (text.size() < form.size()) return false;
  return std::equal(form.begin(), form.end(), text.begin(), [](char wanted, char found) {
    return wanted == '0' ? found >= '0' && found <= '9' : found == wanted;
  });
}

/// Returns the position after a date with time and optional offset at `begin`; `begin` if there is none.
std::size_t end_of_date(std::string_view text, std::size_t begin) {
  const std::string_view rest = text.substr(begin);
  if (!has_form(rest, "0000-00-00T00:00:00") && !has_form(rest, "0000-00-00 00:00:00")) return begin;
  const std::size_t end = std::min(rest.find_first_not_of("0123456789.", 19), rest.size());
  const bool has_offset = has_form(rest.substr(end), "+00:00") || has_form(rest.substr(end), "-00:00");
  return begin + end + (has_offset ? 6 : 0);
}

/// Returns the position of the separator after the value that begins at `begin`, or the end of the text.
std::size_t end_of_value(const std::string& text, std::size_t begin, std::string_view separators) {
  std::size_t at = std::min(text.find_first_not_of(' ', begin), text.size());
  const char first = at < text.size() ? text[at] : '\0';
  const std::size_t opened = at;
  if (first == '"' || first == '\'')
    at = end_of_string(text, at);
  else if (first == '[' || first == '{')
    at = end_of_bracket(text, at);
  else
    at = end_of_date(text, at);
  if (at == std::string::npos) refuse_open_value(text, opened);
  return std::min(text.find_first_of(separators, at), text.size());
}

/// Returns "tilt.rate=2,tilt.step=0.002", each value shortened by `shorten`.
std::string named_values(const std::vector<std::string>& variation, const scenario::Scenario& scenario,
                         const std::function<std::string(const std::string&)>& shorten) {
  std::string name;
  for (const std::string& setting : variation) {
    const std::string key = key_of_setting(setting);
    if (!name.empty()) name += ",";
    name += fmt::format("{}={}", key, shorten(scenario::value_text(scenario, key)));
  }
  return name;
}

/// Whether every file system accepts the character in names and distinguishes it from others; this excludes
/// capitals.
bool is_plain(char c) { return c >= ' ' && c <= '~' && c != '/' && c != '\\' && !(c >= 'A' && c <= 'Z'); }

}  // namespace

std::string key_of_setting(const std::string& setting) {
  return std::string(scenario::trimmed(std::string_view(setting).substr(0, setting.find('='))));
}

std::vector<std::string> settings_without(std::vector<std::string> settings,
                                          const std::vector<std::string>& variation) {
  for (const std::string& change : variation)
    std::erase_if(settings, [&](const std::string& setting) {
      return key_of_setting(setting) == key_of_setting(change);
    });
  return settings;
}

std::string variation_name(const std::vector<std::string>& variation, const scenario::Scenario& scenario) {
  return named_values(variation, scenario, [](const std::string& value) { return value; });
}

std::string folder_name(const std::vector<std::string>& variation, const scenario::Scenario& scenario) {
  constexpr std::size_t longest = 100, longest_cut = 60;  // bytes
  std::string whole = variation_name(variation, scenario);
  if (whole.size() <= longest && std::ranges::all_of(whole, is_plain)) return whole;
  std::string name = named_values(variation, scenario, [](const std::string& value) {
    return value.substr(value.rfind('/') + 1);  // the entire value if it has no slash
  });
  for (char& c : name)
    if (c < ' ' || c > '~' || c == '\\') c = '_';
  return fmt::format("{}~{}", name.substr(0, longest_cut),
                     hash_text(hash_bytes(std::as_bytes(std::span(whole)))));
}

std::vector<std::vector<std::string>> parse_axis(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) refuse_axis(text);
  const std::vector<std::string> keys = split(text.substr(0, equals), ':');
  const std::string_view separators = keys.size() > 1 ? ",:" : ",";
  std::vector<std::vector<std::string>> variations = {{}};
  for (std::size_t begin = equals + 1;;) {
    const std::size_t end = end_of_value(text, begin, separators);
    const std::string_view value = scenario::trimmed(std::string_view(text).substr(begin, end - begin));
    const std::size_t k = variations.back().size();
    if (k == keys.size() || scenario::trimmed(keys[k]).empty() || value.empty()) refuse_axis(text);
    variations.back().push_back(fmt::format("{}={}", scenario::trimmed(keys[k]), value));
    const bool is_last = end == text.size();
    if ((is_last || text[end] == ',') && variations.back().size() != keys.size()) refuse_axis(text);
    if (is_last) return variations;
    if (text[end] == ',') variations.emplace_back();
    begin = end + 1;
  }
}

}  // namespace talus::ensemble
