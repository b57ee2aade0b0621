#include "app/help_text.h"

#include <algorithm>
#include <cctype>
#include <fmt/core.h>
#include <vector>

namespace talus::app {
namespace {

constexpr std::size_t line_width = 80, name_width = 24;

struct Example {
  std::string_view command;  ///< its name without that of the program
  std::string_view text;
};

constexpr Example examples[] = {
    {"run", "talus run assets/scenarios/demo.toml --set contact.friction=0.3 -o demo.h5"},
    {"check", "talus check assets/scenarios/demo.toml"},
    {"info", "talus info demo.h5"},
    {"replay", "talus replay demo.h5"},
    {"repair", "talus repair damaged.h5 -o whole.h5"},
    {"view", "talus view demo.h5 --at repose --map coarse+forces"},
    {"render", "talus render demo.h5 --map gamma,clusters --at 0,10,repose"},
    {"panel", "talus panel demo.h5 --map clusters --at 0,10,repose -o clusters.png"},
    {"animate", "talus animate demo.h5 --map coarse+forces --speed 2 -o demo.mp4"},
    {"maps", "talus maps"},
    {"analyze", "talus analyze demo.h5"},
    {"events", "talus events demo.h5 --largest 20"},
    {"figures", "talus figures demo.h5 -o figures"},
    {"export", "talus export demo.h5 --to paraview --at 0,10,repose -o paraview"},
    {"ensemble", "talus ensemble assets/scenarios/demo.toml --seeds 1-8 -o beds"},
    {"ensemble work", "talus ensemble work beds"},
    {"ensemble status", "talus ensemble status beds"},
    {"ensemble average", "talus ensemble average beds"},
    {"ensemble retry", "talus ensemble retry beds"},
    {"ensemble submit", "talus ensemble submit beds --tasks 8 -- --partition=short"},
    {"ensemble cancel", "talus ensemble cancel beds"},
    {"study", "talus study assets/scenarios/demo.toml --vary tilt.step=0.002,0.0005 --seeds 1-4 -o study"},
    {"perturb", "talus perturb assets/scenarios/metastability.toml --seeds 1-4 -o pushes"},
    {"reproduce", "talus reproduce --quick -o reproduction"},
    {"dump", "talus dump demo.h5 --at 10 -o problem.h5"},
    {"solve", "talus solve problem.h5 --cold --tol 1e-4"},
    {"forces", "talus forces demo.h5 --at 10"},
};

void add_examples_below(CLI::App& app, const std::string& words) {
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    const std::string name = words + command->get_name();
    add_examples_below(*command, name + " ");
    const auto* const found = std::ranges::find(examples, name, &Example::command);
    if (found == std::end(examples)) continue;
    const std::string before = command->get_footer();
    command->footer(fmt::format("{}{}Example:\n  {}", before, before.empty() ? "" : "\n", found->text));
  }
}

/// Returns "DEG in [2 - 89]" for "DEG:in [2 - 89]", and the choices for "CHOICE:{a,b}"; empty for an
/// argument, whose name is sufficient.
std::string value_text(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t colon = type.find(":in ["), choices = type.find(":{");
  if (choices != std::string::npos) return type.substr(choices + 1);
  const std::string word = option.get_positional() ? "" : type.substr(0, colon);
  const std::string range = colon == std::string::npos ? "" : type.substr(colon + 1);
  return word + (word.empty() || range.empty() ? "" : " ") + range;
}

/// Removes the brackets in which the parser shows several values, as in "[0,10]".
std::string without_brackets(const std::string& text) {
  const bool has_them = text.size() > 1 && text.starts_with('[') && text.ends_with(']');
  return has_them ? text.substr(1, text.size() - 2) : text;
}

}  // namespace

const char* const first_example =
    "First steps, in the folder that contains assets/scenarios (in an installation\n"
    "share/talus/scenarios):\n"
    "  talus run assets/scenarios/demo.toml -o demo.h5\n"
    "  talus render demo.h5 --map clusters --at 0,10,repose\n"
    "  talus view demo.h5";

std::string wrapped(const std::string& text, std::size_t width) {
  std::string result, rest = text;
  while (rest.size() > width || rest.find('\n') != std::string::npos) {
    std::size_t end = rest.find('\n');
    if (end > width) end = rest.rfind(' ', width);
    if (end == std::string::npos) end = rest.find(' ');
    if (end == std::string::npos) break;
    result += rest.substr(0, end) + "\n";
    rest.erase(0, end + 1);
  }
  return result + rest;
}

namespace {

/// Returns the row of an option or a command: its name, and the lines of its description next to or below it.
std::string help_row(const std::string& name, const std::string& description) {
  std::string row = fmt::format("{:<{}}", "  " + name, name_width);
  const std::string next = "\n" + std::string(name_width, ' ');
  if (!description.empty() && name.size() + 2 >= name_width) row += next;
  for (const char c : wrapped(description, line_width - name_width))
    row += c == '\n' ? next : std::string(1, c);
  return row + "\n";
}

std::string option_name(const CLI::Option& option) {
  const bool positional = option.get_positional();
  return option.get_name(positional, !positional);
}

/// Returns the name of an argument, in brackets unless it is required.
std::string argument_usage(const CLI::Option& argument) {
  const bool many = argument.get_expected_max() >= CLI::detail::expected_max_vector_size;
  const std::string name = option_name(argument) + (many ? "..." : "");
  return argument.get_required() ? " " + name : " [" + name + "]";
}

std::string option_row(const CLI::Option& option) {
  std::string text = option_name(option);
  if (option.get_type_size() != 0) {
    if (const std::string value = value_text(option); !value.empty()) text += " " + value;
    if (const std::string standard = without_brackets(option.get_default_str()); !standard.empty())
      text += fmt::format(" [{}]", standard);
    if (option.get_expected_max() == CLI::detail::expected_max_vector_size) text += " ...";
    if (option.get_required()) text += " (required)";
  }
  for (const CLI::Option* other : option.get_needs()) text += " with " + other->get_name();
  for (const CLI::Option* other : option.get_excludes()) text += " without " + other->get_name();
  return help_row(text, option.get_description());
}

/// Versions of CLI11 call the group of items that are given none "Options" or "OPTIONS".
std::string title(std::string group) {
  if (group == "OPTIONS" || group == "SUBCOMMANDS")
    std::transform(group.begin() + 1, group.end(), group.begin() + 1,
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return "\n" + group + ":\n";
}

/// Returns the rows of the items below the titles of their groups, in the order in which groups begin; the
/// group "" is hidden.
template <typename Items, typename Row>
std::string grouped(const Items& items, const Row& row) {
  std::string text;
  std::vector<std::string> groups = {""};
  for (const auto* first : items) {
    const std::string group = first->get_group();
    if (std::ranges::find(groups, group) != groups.end()) continue;
    groups.push_back(group);
    text += title(group);
    for (const auto* item : items)
      if (item->get_group() == group) text += row(*item);
  }
  return text;
}

std::string command_row(const CLI::App& command) {
  return help_row(command.get_name(), command.get_description());
}

}  // namespace

std::string HelpText::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode) const {
  const auto arguments = app->get_options([](const CLI::Option* option) { return option->get_positional(); });
  const auto options = app->get_options([](const CLI::Option* option) { return option->nonpositional(); });
  const auto commands = app->get_subcommands([](const CLI::App*) { return true; });

  std::string text = app->get_description() + "\nUsage: " + name + (options.empty() ? "" : " [OPTIONS]");
  for (const CLI::Option* argument : arguments) text += argument_usage(*argument);
  if (!commands.empty()) text += app->get_require_subcommand_min() == 0 ? " [SUBCOMMAND]" : " SUBCOMMAND";
  text += "\n";
  if (!arguments.empty()) text += title("Positionals");
  for (const CLI::Option* argument : arguments) text += option_row(*argument);
  text += grouped(options, option_row) + grouped(commands, command_row);
  const std::string footer = app->get_footer();
  return text + "\n" + footer + (footer.empty() ? "" : "\n");
}

void add_examples(CLI::App& app) { add_examples_below(app, ""); }

}  // namespace talus::app
