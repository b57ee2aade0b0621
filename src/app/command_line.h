#pragma once
/// The command line of this process, and messages about words of it that cannot be parsed.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace talus::app {

/// Returns the quoted command line, e.g. `talus figures runs/a.h5 -o 'my figures'`, for provenance.
std::string command_line();

/// Checks the words before they are parsed. Throws Error(usage) for a first word that is not a command of
/// `app`, for a word close to a subcommand (`talus ensemble statsu`), and for a long option with a single
/// dash, which would be parsed as a short option with a value: `-overwrite` as `-o verwrite`.
void check_arguments(const CLI::App& app, const std::vector<std::string>& words);

/// Returns a line on a parse error: an unknown option and the nearest known one, a superfluous word, or the
/// message of the parser, each with a pointer to the help.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error);

}  // namespace talus::app
