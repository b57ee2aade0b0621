#pragma once
/// Plain texts of parse errors in the options of a command.

#include <CLI/CLI.hpp>
#include <string>

namespace talus::app {

/// Returns the option whose value is missing or wrong, the expected kind of value (value_words.h), and what
/// was found.
std::string parse_error_text(const CLI::App& command, const CLI::ParseError& error);

}  // namespace talus::app
