#pragma once
/// Rules that relate several keys of a scenario.

#include <string>
#include <vector>

#include "scenario/scenario.h"

namespace talus::scenario {

inline constexpr double gravity = 9.81;    ///< gravitational acceleration of every run, m/s^2
inline constexpr double max_grains = 2e6;  ///< largest number of grains in a bed

/// A rule that a scenario breaks.
struct BrokenRule {
  std::vector<std::string> keys;  ///< full names of the keys, the one most likely to be wrong first
  std::string expected;           ///< expected and found values, for a message
};

/// Returns the rules broken by a scenario whose keys are individually in range; empty if the scenario can be
/// run.
std::vector<BrokenRule> broken_rules(const Scenario& scenario);

}  // namespace talus::scenario
