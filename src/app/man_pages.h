#pragma once
/// Manual pages of the program and of each command.

#include <string>
#include <utility>
#include <vector>

#include "app/command_tree.h"

namespace talus::app {

/// Returns file names ("talus-run.1") and roff texts, for section 1.
std::vector<std::pair<std::string, std::string>> man_pages(const CommandPage& program);

}  // namespace talus::app
