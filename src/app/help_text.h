#pragma once
/// Layout of the help: line widths, and an example for each command.

#include <CLI/CLI.hpp>
#include <string>

namespace talus::app {

/// Wraps text at blanks to lines of at most `width` characters, if possible; keeps existing line breaks.
std::string wrapped(const std::string& text, std::size_t width);

/// Help for terminals of 80 columns that shows each range once, the same with all versions of CLI11.
class HelpText : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
};

/// Commands for the first steps.
extern const char* const first_example;

/// Appends to the help of each command below `app` its example, if it has one.
void add_examples(CLI::App& app);

}  // namespace talus::app
