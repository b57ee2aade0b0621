#include "app/command_tree.h"

#include <algorithm>

namespace talus::app {
namespace {

/// Returns "DEG" for "DEG:in [0 - 90]"; "HH:MM[:SS]" is a single word.
std::string value_of(const CLI::Option& option) {
  if (option.get_expected_max() == 0) return {};
  const std::string type = option.get_type_name();
  return type.substr(0, std::min({type.find(":{"), type.find(":in ["), type.find(' ')}));
}

/// Returns a and b for "CHOICE:{a,b}".
std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t open = type.find(":{"), close = type.find('}', open);
  if (open == std::string::npos || close == std::string::npos) return {};
  return CLI::detail::split(type.substr(open + 2, close - open - 2), ',');
}

OptionPage page_of(const CLI::Option& option) {
  OptionPage page;
  for (const std::string& name : option.get_snames()) page.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) page.names.push_back("--" + name);
  if (page.names.empty()) page.argument = option.get_name(true);
  page.value = value_of(option);
  page.choices = choices_of(option);
  page.description = option.get_description();
  page.default_text = option.get_default_str();
  page.required = option.get_required();
  return page;
}

/// Adds the options of a command and of its option groups, which the parser treats as commands without a
/// name.
void add_options(const CLI::App& app, std::vector<OptionPage>& options) {
  for (const CLI::Option* option : app.get_options()) {
    const bool help_of_group = app.get_name().empty() && option == app.get_help_ptr();
    if (!option->get_group().empty() && !help_of_group) options.push_back(page_of(*option));
  }
  for (const CLI::App* group :
       app.get_subcommands([](const CLI::App* sub) { return sub->get_name().empty(); }))
    add_options(*group, options);
}

}  // namespace

CommandPage command_tree(const CLI::App& app, const std::string& name) {
  CommandPage page = {name, app.get_description(), app.get_footer(), {}, {}};
  add_options(app, page.options);
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    if (!command->get_name().empty() && !command->get_group().empty())
      page.commands.push_back(command_tree(*command, name + " " + command->get_name()));
  return page;
}

std::string first_clause(const std::string& description) {
  std::size_t end = description.size();
  for (const char* stop : {". ", ": ", "; ", " [", ".\n"}) end = std::min(end, description.find(stop));
  return description.substr(0, end);
}

std::string last_word(const std::string& name) { return name.substr(name.rfind(' ') + 1); }

}  // namespace talus::app
