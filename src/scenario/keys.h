#pragma once
/// The table of all keys of a scenario: section, name, unit, range, meaning, and the field each one sets.
/// Reading, writing, checking and docs/scenario.md are all based on it.

#include <string_view>
#include <vector>

#include "scenario/key.h"
#include "scenario/scenario.h"

namespace talus::scenario {

using ScenarioKey = Key<Scenario>;

/// All keys, section by section, in the order in which a scenario is written.
const std::vector<ScenarioKey>& scenario_keys();

/// The key with that full name ("contact.friction", "seed"); nullptr if there is none.
const ScenarioKey* find_key(std::string_view full_name);

/// The full names of all that a scenario says, those of its commands ("command.1.at") behind the keys.
std::vector<std::string> key_names(const Scenario& scenario);

/// The value of one of them, as plain_text; "none" for one of a command that the scenario does not have.
std::string value_text(const Scenario& scenario, std::string_view full_name);

}  // namespace talus::scenario
