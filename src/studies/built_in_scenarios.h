#pragma once
/// The scenarios of assets/scenarios, which are part of the binary.

#include <string_view>

namespace talus::studies {

/// The text of assets/scenarios/NAME.toml. Throws Error(internal) where there is none.
std::string_view built_in_scenario(std::string_view name);

}  // namespace talus::studies
