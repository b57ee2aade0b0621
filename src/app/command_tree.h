#pragma once
/// The commands of the program and their options as plain data, for man pages and completions.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace talus::app {

/// An option, or an argument that has its place instead of a name.
struct OptionPage {
  std::vector<std::string> names;  ///< "-o", "--output"; none for an argument
  std::string argument;            ///< "RUN"; empty for an option
  std::string value;               ///< what follows its name, "DEG" or "FOLDER"; empty for a flag
  std::vector<std::string> choices;
  std::string description;
  std::string default_text;  ///< empty where there is none to show
  bool required = false;
};

struct CommandPage {
  std::string name;  ///< "talus ensemble submit"
  std::string description, footer;
  std::vector<OptionPage> options;
  std::vector<CommandPage> commands;  ///< without hidden ones
};

/// The tree below a parser. `name` is how it is called.
CommandPage command_tree(const CLI::App& app, const std::string& name);

/// The first clause of a description: what a list has room for.
std::string first_clause(const std::string& description);

/// The last word of the name of a command.
std::string last_word(const std::string& name);

}  // namespace talus::app
