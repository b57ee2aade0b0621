#pragma once
/// Table of all keys of a scenario: section, name, unit, range, meaning, and the member that each key sets.
/// Reading, writing, checking and docs/scenario.md are based on it.

#include <string_view>
#include <vector>

#include "scenario/key.h"
#include "scenario/scenario.h"

namespace talus::scenario {

using ScenarioKey = Key<Scenario>;

/// Returns all keys, section by section, in the order in which a scenario is written.
const std::vector<ScenarioKey>& scenario_keys();

/// Returns the key with this full name ("contact.friction", "seed"); nullptr if there is none.
const ScenarioKey* find_key(std::string_view full_name);

/// Returns the full names of all settings of a scenario, with those of its commands ("command.1.at") last.
std::vector<std::string> key_names(const Scenario& scenario);

/// Returns the value of a setting as plain_text; "none" for a command that the scenario does not have.
std::string value_text(const Scenario& scenario, std::string_view full_name);

}  // namespace talus::scenario
