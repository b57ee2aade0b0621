#pragma once
/// Layout of the help: line widths, and an example for each command.

#include <CLI/CLI.hpp>
#include <string>

namespace talus::app {

/// Wraps text at blanks to lines of at most `width` characters, if possible; keeps existing line breaks.
std::string wrapped(const std::string& text, std::size_t width);

/// Formatter of help for terminals of 80 columns that shows each range once.
class HelpText : public CLI::Formatter {
 public:
  HelpText();
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
  std::string make_subcommand(const CLI::App* command) const override;
};

/// Commands for the first steps.
extern const char* const first_example;

/// Appends to the help of each command below `app` its example, if it has one.
void add_examples(CLI::App& app);

}  // namespace talus::app
