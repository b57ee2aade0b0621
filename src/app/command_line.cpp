#include "app/command_line.h"

#include <algorithm>
#include <fmt/core.h>
#include <fstream>
#include <iterator>
#include <string_view>

#include "app/help_text.h"
#include "base/errors.h"
#include "base/output_file.h"
#include "base/text.h"

namespace talus::app {
namespace {

std::vector<std::string> names_of_commands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : visible_commands(app)) names.push_back(command->get_name());
  return names;
}

const CLI::App* command_called(const CLI::App& app, const std::string& name) {
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    if (!name.empty() && command->get_name() == name) return command;
  return nullptr;
}

/// Returns the names of a command's options with two dashes, without the dashes.
std::vector<std::string> long_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : visible_options(command))
    names.insert(names.end(), option->get_lnames().begin(), option->get_lnames().end());
  return names;
}

std::string without_value(const std::string& word) { return word.substr(0, word.find('=')); }

/// Returns "; did you mean 'render'? talus --help lists them"; `dashes` precede the name.
std::string remedy(const std::string& nearest, const std::string& name, const char* dashes = "") {
  return fmt::format("; {}{} --help lists them",
                     nearest.empty() ? "" : fmt::format("did you mean '{}{}'? ", dashes, nearest), name);
}

void refuse_one_dash(const CLI::App& command, const std::string& name, const std::string& word) {
  if (word.size() < 4 || word[0] != '-' || word[1] == '-') return;
  const std::vector<std::string> names = long_names(command);
  if (std::ranges::find(names, without_value(word).substr(1)) == names.end()) return;
  throw Error(ExitCode::usage, "'{}' is not an option of {}; did you mean '-{}'?", visible_word(word), name,
              visible_word(word));
}

/// A parsed command and its full name.
struct ParsedCommand {
  const CLI::App* command;
  std::string name;
};

/// Returns the program, its command, and the subcommand.
std::vector<ParsedCommand> parsed_commands(const CLI::App& app) {
  std::vector<ParsedCommand> parsed = {{&app, app.get_name()}};
  while (!parsed.back().command->get_subcommands().empty()) {
    const CLI::App* command = parsed.back().command->get_subcommands().front();
    parsed.push_back({command, parsed.back().name + " " + command->get_name()});
  }
  return parsed;
}

/// An option that has another name now.
struct Renamed {
  std::string_view option;
  std::string_view commands;  ///< commands that had it, separated by blanks
  std::string_view now;
};

constexpr std::string_view maps = "render panel animate", live = "render panel animate run";

constexpr Renamed renamed[] = {
    {"--theta-c", live, "'--set gamma_c=X', with the sine of that angle: 0.342 for 20 deg"},
    {"--threshold", maps, "'--set threshold_factors=FACTOR'"},
    {"--l-min", live, "'--set l_min=D'"},
    {"--length", "render panel animate export", "'--set length=D'"},
    {"--joined", maps, "'--set joining=contacts' or '--set joining=neighbours'"},
    {"--frames", "render export", "'--at frame0-frame10,frame20'"},
    {"--width", live, "'--size PIXELS', such as --size 1920"},
    {"--aspect", "animate", "'--size WIDTHxHEIGHT', such as --size 1920x1080"},
    {"--printed", maps, "'--size 8.6cm'"},
    {"--second", "view", "a second window: talus view OTHER"},
    {"--force", "events", "'talus analyze --force', before talus events"},
    {"--threads", "events", "'talus analyze --threads', before talus events"},
};

/// Returns "'--frames' of talus render is now '--at frame0-frame10,frame20'" for an option that the command
/// had earlier; empty for any other.
std::string renamed_option(const std::string& command, const std::string& option) {
  const std::string_view word = std::string_view(command).substr(command.rfind(' ') + 1);
  const auto* const found = std::ranges::find_if(renamed, [&](const Renamed& row) {
    const std::string commands = fmt::format(" {} ", row.commands);
    return row.option == option && commands.find(fmt::format(" {} ", word)) != std::string::npos;
  });
  return found == std::end(renamed) ? "" : fmt::format("'{}' of {} is now {}", option, command, found->now);
}

std::string unknown_option(const ParsedCommand& parsed, const std::string& word) {
  const std::string option = without_value(word);
  if (std::string now = renamed_option(parsed.name, option); !now.empty()) return now;
  const std::string undashed = option.substr(std::min(option.find_first_not_of('-'), option.size()));
  const std::vector<std::string> names = long_names(*parsed.command);
  std::string nearest = nearest_word(undashed, names);
  if ((undashed == "cmap" || undashed == "colormap") && std::ranges::find(names, "colours") != names.end())
    nearest = "colours";  // the name of matplotlib
  std::string text = fmt::format("'{}' is not an option of {}", visible_word(option), parsed.name);
  if (nearest.empty() && parsed.name.ends_with(" submit"))
    return fmt::format("{}; options of sbatch follow --, as in {} FOLDER -- {}", text, parsed.name,
                       visible_word(word));
  return text + remedy(nearest, parsed.name, "--");
}

std::string word_too_many(const ParsedCommand& parsed, const std::string& word) {
  std::string arguments;
  for (const CLI::Option* option : visible_options(*parsed.command))
    if (option->get_positional()) arguments += " " + option->get_name(true);
  return fmt::format("'{}' is one argument too many; expected {}{} and options, which {} --help lists",
                     visible_word(word), parsed.name, arguments, parsed.name);
}

/// Returns the message for the first word that no command accepts, options before others.
std::string unknown_word(const std::vector<ParsedCommand>& commands) {
  for (const bool options : {true, false})
    for (const ParsedCommand& parsed : commands)
      for (const std::string& word : parsed.command->remaining(false)) {
        const bool is_option = word.starts_with('-') && word.size() > 1 && word != "--";
        if (is_option == options && word != "--")
          return options ? unknown_option(parsed, word) : word_too_many(parsed, word);
      }
  return {};
}

/// Returns " (expected --range LOW,HIGH)" for an option with a wrong value; empty if none is named.
std::string expected_value(const CLI::App& command, const CLI::ParseError& error) {
  const std::string kind = error.get_name(), said = error.what();
  if (kind != "ConversionError" && kind != "ArgumentMismatch" && kind != "RequiredError") return {};
  for (const CLI::Option* option : visible_options(command))
    for (const std::string& name : option->get_lnames()) {
      const std::size_t at = said.find("--" + name);
      const bool is_whole =
          at != std::string::npos && said.substr(at + 2).find_first_of(": =,") == name.size();
      if (is_whole || (at != std::string::npos && said.size() == at + 2 + name.size())) {
        const std::string value = value_text(*option);
        return fmt::format(" (expected --{} {})", name, value.empty() ? "without a value" : value);
      }
    }
  return {};
}

}  // namespace

std::string command_line() {
  std::ifstream words("/proc/self/cmdline");
  words.exceptions(std::ios::badbit);  // so that a lack of memory is reported
  std::string text = "talus";
  std::string word;
  std::getline(words, word, '\0');  // skips the path of the program
  while (std::getline(words, word, '\0')) text += fmt::format(" {}", shell_quoted(word));
  return text;
}

void check_arguments(const CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App* command = &app;
  std::string name = app.get_name();
  std::size_t k = 0;
  for (; k < words.size() && !words[k].starts_with('-'); ++k) {
    const CLI::App* const next = command_called(*command, words[k]);
    if (next == nullptr) break;
    command = next;
    name += " " + words[k];
  }
  if (k < words.size() && !words[k].starts_with('-')) {
    const std::string nearest = nearest_word(words[k], names_of_commands(*command));
    const bool is_path = words[k].find_first_of("./") != std::string::npos || is_there(words[k]);
    if (k == 0 || (!is_path && !nearest.empty()))
      throw Error(ExitCode::usage, "'{}' is not a command{}", visible_word(words[k]), remedy(nearest, name));
  }
  for (; k < words.size() && words[k] != "--"; ++k) refuse_one_dash(*command, name, words[k]);
}

std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<ParsedCommand> commands = parsed_commands(app);
  if (std::string unknown = unknown_word(commands); !unknown.empty()) return unknown;
  if (commands.size() == 1)
    return fmt::format("a command is missing, such as talus run SCENARIO.toml; {} --help lists them",
                       app.get_name());
  std::string text = visible_word(error.what(), 500);
  // CLI11 joins the name of a value and its range by a colon.
  if (const std::size_t range = text.find(":("); range != std::string::npos) text[range] = ' ';
  text += expected_value(*commands.back().command, error);
  return fmt::format("{}{} see {} --help", text, text.ends_with('?') ? "" : ";", commands.back().name);
}

}  // namespace talus::app
