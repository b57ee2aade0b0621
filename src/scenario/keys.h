#pragma once
/// Table of all keys of a scenario: section, name, unit, range, meaning, and the member that each key sets.
/// Reading, writing, checking and docs/scenario.md are based on it. Rules relate several keys.

#include <string>
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

inline constexpr double gravity = 9.81;    ///< gravitational acceleration of every run, m/s^2
inline constexpr double max_grains = 2e6;  ///< largest number of grains in a bed

/// A rule that a scenario breaks.
struct BrokenRule {
  std::vector<std::string> keys;  ///< full names of the keys, the one most likely to be wrong first
  std::string expected;           ///< expected and found values, for a message
};

/// Returns the rules broken by a scenario whose keys are in range; empty if it can be run.
std::vector<BrokenRule> broken_rules(const Scenario& scenario);

}  // namespace talus::scenario
