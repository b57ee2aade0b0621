#pragma once
/// Words of a command line that mean nothing, told with those that were meant.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace talus::app {

/// Looks at the words before the parser does. Throws Error(usage) for a first word that is no command of
/// `app`, for one that is near to a command of a command (`talus ensemble statsu`), and for an option with
/// one dash of two, which would be read as a short one with its value: `-overwrite` as `-o verwrite`.
void refuse_words(CLI::App& app, const std::vector<std::string>& words);

/// What the parser has refused, in one line: the option that it does not know and the nearest that it does,
/// the word that is one too many, or what the parser says, each with where to read on.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error);

}  // namespace talus::app
