#include "app/man_pages.h"

#include <algorithm>
#include <fmt/core.h>

#include "base/text.h"
#include "base/version.h"

namespace talus::app {
namespace {

/// Escapes text for roff, so that nothing in it is a request or an escape, and hyphens can be copied.
std::string roff(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const bool begins_line = result.empty() || result.back() == '\n';
    if (begins_line && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
  }
  return result;
}

std::string bold(const std::string& text) { return fmt::format("\\fB{}\\fR", roff(text)); }

/// Replaces blanks: "talus-ensemble-submit".
std::string dashed(std::string name) {
  std::ranges::replace(name, ' ', '-');
  return name;
}

std::string option_item(const OptionPage& option) {
  std::string head = option.names.empty() ? bold(option.argument) : joined(option.names, ", ", bold);
  if (!option.value.empty() && !option.names.empty())
    head += " " + roff(option.choices.empty() ? option.value : joined(option.choices, "|"));
  std::string text = roff(option.description);
  if (!option.default_text.empty()) text += fmt::format(" [{}]", roff(option.default_text));
  if (option.required && !option.names.empty()) text += " (required)";
  return fmt::format(".TP\n{}\n{}\n", head, text);
}

std::string arguments_of(const CommandPage& page) {
  std::string text = page.commands.empty() ? "" : " COMMAND";
  for (const OptionPage& option : page.options)
    if (option.names.empty())
      text += option.required ? " " + roff(option.argument) : fmt::format(" [{}]", roff(option.argument));
  return text;
}

/// Returns the section of a page that lists its arguments or its options; empty if it has none.
std::string items(const char* section, const CommandPage& page, bool arguments) {
  std::string text;
  for (const OptionPage& option : page.options)
    if (option.names.empty() == arguments) text += option_item(option);
  return text.empty() ? "" : fmt::format(".SH {}\n{}", section, text);
}

std::string man_page(const CommandPage& page, const std::string& program) {
  const std::string name = dashed(page.name);
  std::string text = fmt::format(
      ".TH \"{}\" 1 \"\" \"Talus {}\" \"Talus\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{} [OPTIONS]{}\n",
      roff(name), version, roff(name), roff(first_clause(page.description)), bold(page.name),
      arguments_of(page));
  text += fmt::format(".SH DESCRIPTION\n{}\n", roff(page.description));
  if (!page.footer.empty()) text += fmt::format(".PP\n{}\n", roff(page.footer));
  if (!page.commands.empty()) text += ".SH COMMANDS\n";
  for (const CommandPage& command : page.commands)
    text += fmt::format(".TP\n{}\n{}\n", bold(last_word(command.name)), roff(command.description));
  text += items("ARGUMENTS", page, true) + items("OPTIONS", page, false);
  if (page.name != program) text += fmt::format(".SH SEE ALSO\n\\fB{}\\fR(1)\n", roff(program));
  return text;
}

void add_pages(const CommandPage& page, const std::string& program,
               std::vector<std::pair<std::string, std::string>>& pages) {
  pages.emplace_back(dashed(page.name) + ".1", man_page(page, program));
  for (const CommandPage& command : page.commands) add_pages(command, program, pages);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> man_pages(const CommandPage& program) {
  std::vector<std::pair<std::string, std::string>> pages;
  add_pages(program, program.name, pages);
  return pages;
}

}  // namespace talus::app
