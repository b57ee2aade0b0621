#pragma once
/// Values of a scenario as text: exact where they are read back, harmless where they are shown.

#include <string>
#include <string_view>

#include "session/scenario_keys.h"

namespace talus {

/// The shortest decimal that reads back as the same double: "200", "1e-06".
std::string short_text(double value);

/// The value in TOML: 200.0, 1e-06, 7, "periodic".
std::string toml_text(const ScenarioValue& value);

/// Text of a user made fit for a message: at most `limit` characters, and bytes that are not printable ASCII
/// as \xNN.
std::string printable(std::string_view text, std::size_t limit = 60);

}  // namespace talus
