#pragma once
/// How the help of the program looks: what a line holds, and an example of each command.

#include <CLI/CLI.hpp>
#include <string>

namespace talus::app {

/// The text in lines of at most `width` characters, broken at blanks where it can be; lines stay lines.
std::string wrapped(const std::string& text, std::size_t width);

/// Lines that fit a terminal of 80 columns, and each range once.
class HelpText : public CLI::Formatter {
 public:
  HelpText();
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
  std::string make_subcommand(const CLI::App* command) const override;
};

/// What there is to type first.
extern const char* const first_example;

/// Ends the help of each command below `app` that has an example with it.
void add_examples(CLI::App& app);

}  // namespace talus::app
