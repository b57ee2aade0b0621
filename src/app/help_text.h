#pragma once
/// The help of commands, and what is made of it: manual pages and the completions of shells.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace talus::app {

/// Returns the rows of all options but --help, as in the help.
std::string option_rows(const CLI::App& app);

/// Wraps text at blanks to lines of at most `width` characters, if possible; keeps existing line breaks.
std::string wrapped(const std::string& text, std::size_t width);

/// Returns the commands and the options that help shows, in the order in which they were added.
std::vector<const CLI::App*> visible_commands(const CLI::App& app);
std::vector<const CLI::Option*> visible_options(const CLI::App& app);

/// Returns the value of an option as help shows it: "DEG in [2 - 89]", "{a,b}"; empty for a flag, and for an
/// argument, whose name is sufficient.
std::string value_text(const CLI::Option& option);

/// Help for terminals of 80 columns that shows each range once, the same with all versions of CLI11.
class HelpText : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
};

/// Appends to the help of each command below `app` its example, if it has one; `words` precede their names.
void add_examples(CLI::App& app, const std::string& words = "");

/// Writes a manual page of `app` and of each command below it into the folder, with its help as the text.
void write_man_pages(const CLI::App& app, const std::string& folder);

/// Returns what a shell may offer for the last of the words after the name of the program, one per line, each
/// with a blank and a description, if it has one: commands, options, or the values of the option before it.
std::string completions(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace talus::app
