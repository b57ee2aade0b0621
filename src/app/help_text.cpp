#include "app/help_text.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fmt/core.h>

#include "app/map_options.h"
#include "base/output_file.h"
#include "base/version.h"
#include "io/durable_file.h"

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
    {"render", "talus render demo.h5 --at 0,10,repose"},
    {"panel", "talus panel demo.h5 --map clusters --at 0,10,repose --size 8.6cm"},
    {"animate", "talus animate demo.h5 --speed 2 --size 1920x1080"},
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

/// Removes the brackets in which the parser shows several values, as in "[0,10]".
std::string without_brackets(const std::string& text) {
  const bool has_them = text.size() > 1 && text.starts_with('[') && text.ends_with(']');
  return has_them ? text.substr(1, text.size() - 2) : text;
}

/// Returns a and b for a value "{a,b}".
std::vector<std::string> choices_of(const std::string& value) {
  return value.starts_with('{') ? CLI::detail::split(value.substr(1, value.size() - 2), ',')
                                : std::vector<std::string>();
}

/// Escapes text for roff, so that nothing in it is a request or an escape, and hyphens can be copied.
std::string roff(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const bool begins_line = result.empty() || result.back() == '\n';
    if (begins_line && (c == '.' || c == '\'')) result += "\\&";
    result += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
  }
  return result;
}

/// Returns the first clause of a description.
std::string first_clause(const std::string& description) {
  std::size_t end = description.size();
  for (const char* stop : {". ", ": ", "; ", " [", ".\n"}) end = std::min(end, description.find(stop));
  return description.substr(0, end);
}

void write_man_page(const CLI::App& app, const std::string& name, const std::string& folder) {
  std::string dashed = name;
  std::ranges::replace(dashed, ' ', '-');
  io::write_text(
      (std::filesystem::path(folder) / (dashed + ".1")).string(),
      fmt::format(
          ".TH \"{0}\" 1 \"\" \"Talus {1}\" \"Talus\"\n.SH NAME\n{0} \\- {2}\n.SH DESCRIPTION\n.nf\n{3}.fi\n",
          roff(dashed), version, roff(first_clause(app.get_description())),
          roff(HelpText().make_help(&app, name, CLI::AppFormatMode::Normal))));
  for (const CLI::App* command : visible_commands(app))
    write_man_page(*command, name + " " + command->get_name(), folder);
}

}  // namespace

std::vector<const CLI::App*> visible_commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::vector<const CLI::Option*> visible_options(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

std::string value_text(const CLI::Option& option) {
  if (option.get_type_size() == 0 || option.get_expected_max() == 0) return {};
  const std::string type = option.get_type_name();  // with what is checked: "DEG:(2 to 89)", ":{a,b}"
  if (const std::size_t choices = type.find(":{"); choices != std::string::npos)
    return type.substr(choices + 1);
  return option.get_positional() ? std::string() : type.substr(0, type.find(":("));
}

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
  std::string text = option_name(option), description = option.get_description();
  if (option.get_type_size() != 0) {
    if (const std::string value = value_text(option); !value.empty()) text += " " + value;
    if (option.get_expected_max() == CLI::detail::expected_max_vector_size && !text.ends_with("..."))
      text += " ...";
    if (option.get_required()) text += " (required)";
    const std::string type = option.get_type_name(), standard = without_brackets(option.get_default_str());
    if (const std::size_t range = type.find(":("); range != std::string::npos)
      description.insert(description.ends_with(']') ? description.rfind(" [") : description.size(),
                         " " + type.substr(range + 1));
    if (!standard.empty()) description += fmt::format(" [{}]", standard);
  }
  for (const CLI::Option* other : option.get_needs()) text += " with " + other->get_name();
  for (const CLI::Option* other : option.get_excludes()) text += " without " + other->get_name();
  return help_row(text, description);
}

/// Versions of CLI11 call the group of items that are given none "Options" or "OPTIONS".
std::string title(std::string group) {
  if (group == "OPTIONS" || group == "SUBCOMMANDS")
    std::transform(group.begin() + 1, group.end(), group.begin() + 1,
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return "\n" + group + ":\n";
}

/// Returns the line that stands for the options of maps, whose page is that of `talus maps`.
std::string maps_row(const std::vector<const CLI::Option*>& options) {
  std::string names;
  std::size_t count = 0;
  for (const CLI::Option* option : options)
    if (option->get_group() == map_group && ++count <= 3)
      names.append(names.empty() ? "" : ", ").append(option->get_name(false, true));
  return fmt::format("\nMaps: talus maps --help describes {}{}\n", names,
                     count > 3 ? " and other options" : "");
}
std::string maps_row(const std::vector<const CLI::App*>&) { return {}; }

/// Returns the rows of the items below the titles of their groups, in order; the group "" is hidden.
template <typename Items, typename Row>
std::string grouped(const Items& items, const Row& row) {
  std::string text;
  std::vector<std::string> groups = {""};
  for (const auto* first : items) {
    const std::string group = first->get_group();
    if (std::ranges::find(groups, group) != groups.end()) continue;
    groups.push_back(group);
    if (group == map_group) {
      text += maps_row(items);
      continue;
    }
    text += title(group);
    for (const auto* item : items)
      if (item->get_group() == group) text += row(*item);
  }
  return text;
}

}  // namespace

std::string option_rows(const CLI::App& app) {
  std::string rows;
  for (const CLI::Option* option : app.get_options())
    if (option != app.get_help_ptr()) rows += option_row(*option);
  return rows;
}

std::string HelpText::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode) const {
  const auto arguments = app->get_options([](const CLI::Option* option) { return option->get_positional(); });
  const auto options = app->get_options([](const CLI::Option* option) { return option->nonpositional(); });
  const std::vector<const CLI::App*> commands = visible_commands(*app);

  std::string text = app->get_description() + "\nUsage: " + name + (options.empty() ? "" : " [OPTIONS]");
  for (const CLI::Option* argument : arguments) text += argument_usage(*argument);
  if (!commands.empty()) text += app->get_require_subcommand_min() == 0 ? " [SUBCOMMAND]" : " SUBCOMMAND";
  text += "\n";
  if (!arguments.empty()) text += title("Positionals");
  for (const CLI::Option* argument : arguments) text += option_row(*argument);
  text += grouped(options, option_row) + grouped(commands, [](const CLI::App& command) {
            return help_row(command.get_name(), command.get_description());
          });
  const std::string footer = app->get_footer();
  return text + "\n" + footer + (footer.empty() ? "" : "\n");
}

void add_examples(CLI::App& app, const std::string& words) {
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    const std::string name = words + command->get_name();
    add_examples(*command, name + " ");
    const auto* const found = std::ranges::find(examples, name, &Example::command);
    if (found == std::end(examples)) continue;
    const std::string before = command->get_footer();
    const char* const gap = before.empty() ? "" : before.ends_with('\n') ? "\n" : "\n\n";
    command->footer(fmt::format("{}{}Example:\n  {}", before, gap, found->text));
  }
}

void write_man_pages(const CLI::App& app, const std::string& folder) {
  prepare_folder(folder);
  write_man_page(app, app.get_name(), folder);
}

std::string completions(const CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App* command = &app;
  const CLI::Option* before = nullptr;  // the option whose value comes next
  for (std::size_t k = 0; k + 1 < words.size(); ++k) {
    before = words[k].starts_with('-') ? command->get_option_no_throw(words[k]) : nullptr;
    if (before != nullptr && before->get_expected_max() == 0) before = nullptr;
    const std::vector<const CLI::App*> below = visible_commands(*command);
    const auto next = std::ranges::find(below, words[k], &CLI::App::get_name);
    if (next != below.end()) command = *next;
  }
  std::string offers;
  const auto offer = [&offers](const std::string& word, const std::string& description) {
    offers += fmt::format("{}{}{}\n", word, description.empty() ? "" : " ", first_clause(description));
  };
  if (before != nullptr) {
    for (const std::string& choice : choices_of(value_text(*before))) offer(choice, "");
  } else if (!words.empty() && words.back().starts_with('-')) {
    for (const CLI::Option* option : visible_options(*command)) {
      for (const std::string& name : option->get_lnames()) offer("--" + name, option->get_description());
      for (const std::string& name : option->get_snames()) offer("-" + name, option->get_description());
    }
  } else {
    for (const CLI::App* below : visible_commands(*command))
      if (words.empty() || below->get_name().starts_with(words.back()))
        offer(below->get_name(), below->get_description());
  }
  return offers;
}

}  // namespace talus::app
