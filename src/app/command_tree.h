#pragma once
/// The commands of the program and their options as plain data, for man pages and completions.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace talus::app {

/// An option or a positional argument.
struct OptionPage {
  std::vector<std::string> names;  ///< "-o", "--output"; empty for an argument
  std::string argument;            ///< "RUN"; empty for an option
  std::string value;               ///< placeholder of its value, "DEG" or "FOLDER"; empty for a flag
  std::vector<std::string> choices;
  std::string description;
  std::string default_text;  ///< empty if none is shown
  bool required = false;
};

struct CommandPage {
  std::string name;  ///< "talus ensemble submit"
  std::string description, footer;
  std::vector<OptionPage> options;
  std::vector<CommandPage> commands;  ///< without hidden ones
};

/// Returns the tree below a parser; `name` is the full name of the command.
CommandPage command_tree(const CLI::App& app, const std::string& name);

/// Returns the first clause of a description, for lists with little space.
std::string first_clause(const std::string& description);

/// Returns the last word of the name of a command.
std::string last_word(const std::string& name);

}  // namespace talus::app
