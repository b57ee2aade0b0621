#pragma once
/// Values of keys as text that reads back exactly.

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace talus::scenario {

/// The value of a key, with the types of TOML.
using KeyValue =
    std::variant<std::int64_t, double, std::string, std::vector<double>, std::vector<std::string>, bool>;

/// Removes blanks at both ends.
std::string_view trimmed(std::string_view text);

/// Returns the shortest decimal that reads back as the same double: "200", "1e-06".
std::string short_text(double value);

/// Returns the value in TOML: 200.0, 1e-06, 7, "periodic", [1.0, 2.0], ["to 12", "to 0"].
std::string toml_text(const KeyValue& value);

/// Returns the value as written in a setting: 200, 1e-06, periodic, 1,2, or "to 12, to 0".
std::string plain_text(const KeyValue& value);

}  // namespace talus::scenario
