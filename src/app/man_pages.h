#pragma once
/// Manual pages, of the program and of each of its commands.

#include <string>
#include <utility>
#include <vector>

#include "app/command_tree.h"

namespace talus::app {

/// Names of files ("talus-run.1") and their texts, for section 1, in the language of man.
std::vector<std::pair<std::string, std::string>> man_pages(const CommandPage& program);

}  // namespace talus::app
