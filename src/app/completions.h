#pragma once
/// Shell completions of commands, options, and the values of options with few choices.

#include <string>

#include "app/command_tree.h"

namespace talus::app {

/// Returns a script that the shell loads when `talus` is first completed; words it does not know are
/// completed as file names.
std::string bash_completion(const CommandPage& program);
std::string zsh_completion(const CommandPage& program);
std::string fish_completion(const CommandPage& program);

}  // namespace talus::app
