#pragma once
/// Values of keys as text, exact if they are read back.

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace talus::scenario {

/// The value of a key, as in TOML.
using KeyValue =
    std::variant<std::int64_t, double, std::string, std::vector<double>, std::vector<std::string>, bool>;

/// The shortest decimal that reads back as the same double: "200", "1e-06".
std::string short_text(double value);

/// The value in TOML: 200.0, 1e-06, 7, "periodic", [1.0, 2.0], ["to 12", "to 0"].
std::string toml_text(const KeyValue& value);

/// The value as it is written in a setting: 200, 1e-06, periodic, 1,2, or "to 12, to 0".
std::string plain_text(const KeyValue& value);

}  // namespace talus::scenario
