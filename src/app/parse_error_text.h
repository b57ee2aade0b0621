#pragma once
/// What the parser finds wrong with the options of a command, in plain words.

#include <CLI/CLI.hpp>
#include <string>

namespace talus::app {

/// Which value of which option is missing or wrong, what is expected of it by its word (value_words.h), and
/// what was found.
std::string parse_error_text(const CLI::App& command, const CLI::ParseError& error);

}  // namespace talus::app
