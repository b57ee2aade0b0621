#pragma once
/// Completions of shells: commands, options, and the values of those that have few.

#include <string>

#include "app/command_tree.h"

namespace talus::app {

/// Scripts that the shell loads when `talus` is first completed; where nothing is known it completes names of
/// files.
std::string bash_completion(const CommandPage& program);
std::string zsh_completion(const CommandPage& program);
std::string fish_completion(const CommandPage& program);

}  // namespace talus::app
