#pragma once
/// Conditions between the keys of a scenario.

#include <string>
#include <vector>

#include "scenario/scenario.h"

namespace talus::scenario {

inline constexpr double gravity = 9.81;     ///< m/s^2, of every run
inline constexpr double most_grains = 2e6;  ///< of a bed

struct BrokenRule {
  std::vector<std::string> keys;  ///< full names of its keys, the one most likely to be wrong first
  std::string expected;           ///< for a message: what was expected and what was found
};

/// The rules that are broken by a scenario whose keys are each in range; none if it can be run.
std::vector<BrokenRule> broken_rules(const Scenario& scenario);

}  // namespace talus::scenario
