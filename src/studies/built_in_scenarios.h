#pragma once
/// The scenarios of assets/scenarios, embedded in the program.

#include <string_view>

namespace talus::studies {

/// Returns the text of assets/scenarios/NAME.toml. Throws Error(internal) if it does not exist.
std::string_view built_in_scenario(std::string_view name);

}  // namespace talus::studies
