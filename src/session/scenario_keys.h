#pragma once
/// The table of all keys of a scenario: section, name, unit, range, meaning, and the field each one sets.
/// Reading, writing, checking and docs/scenario.md all go by it.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "session/scenario.h"

namespace talus {

/// The value of a key, as it stands in TOML.
using ScenarioValue = std::variant<std::int64_t, double, std::string>;

/// A finite number from `low` (itself included or not) to `high`; or, where there is a `word`, that string.
struct NumberRange {
  double low = 0.0;
  double high = 0.0;  ///< infinite: no upper end
  bool low_included = true;
  std::string word;
};

struct IntegerRange {
  std::int64_t low = 0;
  std::int64_t high = 0;
};

/// One of some strings, in the order of the enumerators they stand for.
struct Choices {
  std::vector<std::string> names;
};

/// Any string without a zero byte, of at most so many bytes; the empty one stands for none.
struct TextRange {
  std::string what;  ///< "the path of a file"
  std::size_t longest = 0;
};

struct ScenarioKey {
  std::string section;  ///< empty for a key above the first section
  std::string name;
  std::string unit;  ///< empty for a number without one
  std::variant<NumberRange, IntegerRange, Choices, TextRange> range;
  std::string help;
  std::function<ScenarioValue(const Scenario&)> get;
  /// Takes what admitted() returned.
  std::function<void(Scenario&, const ScenarioValue&)> set;
};

/// All keys, section by section, in the order in which a scenario is written.
const std::vector<ScenarioKey>& scenario_keys();

/// The key of a full name ("contact.friction", "seed"); nullptr where there is none.
const ScenarioKey* find_key(std::string_view full_name);

/// "contact.friction", "seed".
std::string full_name(const ScenarioKey& key);

/// "a number in [0, 1]", "an integer in 1 ... 100", "\"periodic\" or \"walls\"".
std::string range_text(const ScenarioKey& key);

/// range_text with the unit: what a message says was expected.
std::string expectation(const ScenarioKey& key);

/// The value as the key holds it (an integer becomes a number where a number is expected); nothing where the
/// value is of another kind or out of range.
std::optional<ScenarioValue> admitted(const ScenarioKey& key, const ScenarioValue& value);

}  // namespace talus
