#include "app/parse_error_text.h"

#include <algorithm>
#include <cctype>
#include <fmt/core.h>
#include <string_view>

#include "base/text.h"
#include "base/visible_text.h"

namespace talus::app {
namespace {

/// Returns the text before `part`; all of it if `part` does not occur.
std::string before(const std::string& text, std::string_view part) { return text.substr(0, text.find(part)); }

/// Returns the text after `part`; empty if `part` does not occur.
std::string after(const std::string& text, std::string_view part) {
  const std::size_t at = text.find(part);
  return at == std::string::npos ? std::string() : text.substr(at + part.size());
}

/// Returns the option with this name of a command or of one of its groups; null if there is none.
const CLI::Option* option_called(const CLI::App& command, const std::string& name) {
  for (const CLI::Option* option : command.get_options())
    if (option->get_name() == name || option->get_name(true) == name) return option;
  for (const CLI::App* group :
       command.get_subcommands([](const CLI::App* sub) { return sub->get_name().empty(); }))
    if (const CLI::Option* option = option_called(*group, name)) return option;
  return nullptr;
}

/// Returns "DEG" for "DEG:in [0 - 90]", or the choices.
std::string value_of(const CLI::Option& option) {
  const std::string type = option.get_type_name(), choices = after(type, ":{");
  return choices.empty() ? before(type, ":in [") : "{" + choices;
}

/// Returns the first sentence of a description, without the default. "e.g. " does not end a sentence.
std::string first_sentence(const std::string& description) {
  std::string text = before(description, " [");
  for (std::size_t at = text.find(". "); at != std::string::npos; at = text.find(". ", at + 1))
    if (std::isupper(static_cast<unsigned char>(text[at + 2])) != 0) return text.substr(0, at);
  return text;
}

/// Returns "--range: expected LOW,HIGH, found 0..1 (LOW,HIGH: ends of the bar ...)".
std::string expected(const CLI::Option& option, const std::string& found) {
  return fmt::format("{}: expected {}, found {} ({})", option.get_name(), value_of(option), found,
                     first_sentence(option.get_description()));
}

std::string missing(const CLI::App& command, const std::string& said) {
  if (const std::string options = before(after(said, "["), "]"); !options.empty())
    return fmt::format("expected {} of {}", said.find("were given") == std::string::npos ? "one" : "only one",
                       options);
  const std::string name = before(said, " is required");
  const CLI::Option* option = option_called(command, name);
  if (option == nullptr) return said.starts_with("A subcommand") ? "a subcommand is missing" : said;
  if (option->get_positional()) return name + " is missing";
  return fmt::format("{} is missing: expected {} {}", name, name, value_of(*option));
}

/// Describes too many or too few values.
std::string miscounted(const CLI::App& command, const std::string& said) {
  if (const std::string flag = before(said, " was given a disallowed"); flag != said)
    return flag + " takes no value";
  const std::string counted = after(said, "arguments to ");
  const std::string name = counted.empty() ? before(said, ": ") : before(counted, ", got");
  const CLI::Option* option = option_called(command, name);
  if (option == nullptr) return said;
  const std::vector<std::string> values = option->results();
  if (option->get_expected_max() == 1 && values.size() > 1)
    return fmt::format("{} was given {} times; expected one {}", name, values.size(), value_of(*option));
  return expected(*option, values.empty() ? "nothing" : visible_word(joined(values, ",")));
}

/// Describes errors such as "Could not convert: --seed = abc".
std::string unread(const CLI::App& command, const std::string& said) {
  if (!said.starts_with("Could not convert: ")) return before(said, ":") + " takes no value";
  const std::string name = before(after(said, ": "), " = "), found = visible_word(after(said, " = "));
  const CLI::Option* option = option_called(command, name);
  if (option != nullptr && option->get_expected_max() == 0) return name + " takes no value";
  if (option != nullptr && option->get_expected_min() > 1) return expected(*option, found);
  return fmt::format("{}: expected a number, found {}", name, found);
}

}  // namespace

std::string parse_error_text(const CLI::App& command, const CLI::ParseError& error) {
  std::string said = error.what(), kind = error.get_name();
  if (kind == "RequiredError") return missing(command, said);
  if (kind == "RequiresError")
    return fmt::format("{} needs {}", before(said, " requires "), after(said, " requires "));
  if (kind == "ExcludesError")
    return fmt::format("{} and {} exclude each other: leave one out", before(said, " excludes "),
                       after(said, " excludes "));
  if (kind == "ArgumentMismatch") return miscounted(command, said);
  if (kind == "ConversionError") return unread(command, said);
  return said;
}

}  // namespace talus::app
