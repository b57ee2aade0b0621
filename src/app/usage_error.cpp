#include "app/usage_error.h"

#include <algorithm>
#include <fmt/core.h>
#include <optional>

#include "app/command_tree.h"
#include "app/parse_error_text.h"
#include "base/errors.h"
#include "base/nearest_word.h"
#include "base/paths.h"
#include "base/text.h"
#include "base/visible_text.h"
#include "scenario/keys.h"
#include "scenario/setting_forms.h"

namespace talus::app {
namespace {

/// Other names for what these commands do.
struct Synonym {
  std::string_view written, meant;
};
constexpr Synonym other_words[] = {
    {"plot", "'figures' or 'render'"},
    {"draw", "'render' or 'view'"},
    {"picture", "'render'"},
    {"pictures", "'render'"},
    {"image", "'render'"},
    {"map", "'render' or 'maps'"},
    {"movie", "'animate'"},
    {"video", "'animate'"},
    {"show", "'view' or 'info'"},
    {"open", "'view'"},
    {"window", "'view'"},
    {"gui", "'view'"},
    {"simulate", "'run'"},
    {"start", "'run'"},
    {"compute", "'run'"},
    {"resume", "'run --resume RUN'"},
    {"continue", "'run --resume RUN'"},
    {"validate", "'check'"},
    {"verify", "'check'"},
    {"test", "'check'"},
    {"stats", "'analyze' or 'info'"},
    {"measure", "'analyze'"},
    {"convert", "'export'"},
    {"sweep", "'ensemble' or 'study'"},
    {"push", "'perturb'"},
    {"paper", "'reproduce'"},
};

std::vector<CLI::App*> commands_of(CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_name().empty(); });
}

std::vector<std::string> names_of_commands(CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(app))
    if (!command->get_group().empty()) names.push_back(command->get_name());
  return names;
}

CLI::App* command_called(CLI::App& app, const std::string& name) {
  for (CLI::App* command : commands_of(app))
    if (command->get_name() == name) return command;
  return nullptr;
}

/// Returns the likely meaning of a word that is not a command: a similar command, a synonym, a subcommand, or
/// a command that takes such a file; empty if unknown.
std::string likely_command(CLI::App& app, const std::string& word) {
  if (word.ends_with(".toml")) return fmt::format("'run {}'", visible_word(word));
  if (word.ends_with(".h5")) return fmt::format("'view {0}' or 'info {0}'", visible_word(word));
  for (const Synonym& other : other_words)
    if (other.written == word) return std::string(other.meant);
  for (CLI::App* command : commands_of(app))
    if (command_called(*command, word) != nullptr) return fmt::format("'{} {}'", command->get_name(), word);
  const std::string nearest = nearest_word(word, names_of_commands(app));
  return nearest.empty() ? "" : fmt::format("'{}'", nearest);
}

[[noreturn]] void refuse_command(CLI::App& app, const std::string& word) {
  const std::string meant = likely_command(app, word);
  throw Error(ExitCode::usage,
              fmt::format("'{}' is not a command; {}{} --help lists them", visible_word(word),
                          meant.empty() ? "" : "did you mean " + meant + "? ", app.get_name()));
}

/// Returns the names of a command's options with two dashes.
std::vector<std::string> long_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const OptionPage& option : command_tree(command, "").options)
    for (const std::string& name : option.names)
      if (name.starts_with("--")) names.push_back(name);
  return names;
}

std::string without_value(const std::string& word) { return word.substr(0, word.find('=')); }

void refuse_one_dash(const CLI::App& command, const std::string& name, const std::string& word) {
  if (word.size() < 4 || word[0] != '-' || word[1] == '-') return;
  const std::vector<std::string> names = long_names(command);
  const std::string meant = "-" + without_value(word);
  if (std::ranges::find(names, meant) == names.end()) return;
  throw Error(ExitCode::usage, fmt::format("'{}' is not an option of {}; did you mean '-{}'?",
                                           visible_word(word), name, visible_word(word)));
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

const CLI::Option* settings_of(const CLI::App& command) { return command.get_option_no_throw("--set"); }

/// Returns the setting that `--contact.friction` or `--friction` stands for, or several, joined by "' or '";
/// empty if the word is not a key of a scenario, or the command has no settings of one.
std::string setting_meant(const CLI::App& command, const std::string& word) {
  if (settings_of(command) == nullptr ||
      settings_of(command)->get_description().find("scenario") == std::string::npos)
    return {};
  const scenario::KeyHeads keys = scenario::heads(scenario::scenario_keys());
  const std::string name = without_value(word), key = scenario::meant_key(keys, name);
  const std::vector<std::string> meant = key.empty() ? scenario::keys_called(keys, name) : std::vector{key};
  const std::string value = name.size() == word.size() ? "VALUE" : word.substr(name.size() + 1);
  return joined(meant, "' or '",
                [&value](const std::string& one) { return fmt::format("--set {}={}", one, value); });
}

std::string unknown_option(const ParsedCommand& parsed, const std::string& word) {
  const std::string undashed = without_value(word.substr(std::min(word.find_first_not_of('-'), word.size())));
  std::vector<std::string> names = long_names(*parsed.command);
  for (std::string& name : names) name.erase(0, 2);
  const std::string nearest = nearest_word(undashed, names);
  std::string meant = setting_meant(*parsed.command, word);
  if (!nearest.empty() && (meant.empty() || edit_distance(undashed, nearest) < 3)) meant = "--" + nearest;
  return fmt::format(
      "'{}' is not an option of {}; {}{} --help lists them", visible_word(without_value(word)), parsed.name,
      meant.empty() ? "" : fmt::format("did you mean '{}'? ", visible_word(meant, 200)), parsed.name);
}

/// Explains words that a mistyped setting leaves: 0.3 from `--set contact.friction 0.3`, all of
/// `contact.friction=0.3` without --set.
std::optional<std::string> stray_setting(const CLI::App& command, const std::string& word) {
  const CLI::Option* option = settings_of(command);
  if (option == nullptr) return std::nullopt;
  if (!option->results().empty() && option->results().back().find('=') == std::string::npos)
    return fmt::format("--set {} {}: expected one word; did you mean '--set {}={}'?",
                       visible_word(option->results().back()), visible_word(word),
                       visible_word(option->results().back()), visible_word(word));
  if (word.find('=') == std::string::npos) return std::nullopt;
  return fmt::format("'{}': each setting needs its own --set; did you mean '--set {}'?", visible_word(word),
                     visible_word(word));
}

std::string word_too_many(const ParsedCommand& parsed, const std::string& word) {
  if (const auto setting = stray_setting(*parsed.command, word)) return *setting;
  std::string arguments;
  for (const OptionPage& option : command_tree(*parsed.command, parsed.name).options)
    if (option.names.empty()) arguments += " " + option.argument;
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

}  // namespace

void check_arguments(CLI::App& app, const std::vector<std::string>& words) {
  if (words.empty() || words[0].starts_with('-')) return;
  CLI::App* command = command_called(app, words[0]);
  if (command == nullptr) refuse_command(app, words[0]);
  std::string name = app.get_name() + " " + words[0];
  std::size_t first = 1;
  const std::vector<std::string> below = names_of_commands(*command);
  if (words.size() > 1 && !below.empty() && !words[1].starts_with('-')) {
    CLI::App* const next = command_called(*command, words[1]);
    const bool is_path = words[1].find_first_of("./") != std::string::npos || is_there(words[1]);
    if (next == nullptr && !is_path)
      if (const std::string nearest = nearest_word(words[1], below); !nearest.empty())
        throw Error(ExitCode::usage,
                    fmt::format("'{}' is neither a file nor a command of {}; did you mean '{} {}'?",
                                visible_word(words[1]), name, name, nearest));
    if (next != nullptr) name += " " + words[first++], command = next;
  }
  for (std::size_t k = first; k < words.size() && words[k] != "--"; ++k)
    refuse_one_dash(*command, name, words[k]);
}

std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<ParsedCommand> commands = parsed_commands(app);
  if (std::string unknown = unknown_word(commands); !unknown.empty()) return unknown;
  if (commands.size() == 1)
    return fmt::format("a command is missing, such as talus run SCENARIO.toml; {} --help lists them",
                       app.get_name());
  std::string said = parse_error_text(*commands.back().command, error);
  while (said.ends_with('\n') || (said.ends_with('.') && !said.ends_with("..."))) said.pop_back();
  return fmt::format("{}{} see {} --help", said, said.ends_with('?') ? "" : ";", commands.back().name);
}

}  // namespace talus::app
