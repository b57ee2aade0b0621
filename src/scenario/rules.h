#pragma once
/// Conditions between the keys of a scenario.

#include <string>
#include <vector>

#include "scenario/scenario.h"

namespace talus::scenario {

struct BrokenRule {
  std::vector<std::string> keys;  ///< full names of its keys, the one most likely to be wrong first
  std::string expected;           ///< for a message: what was expected and what was found
};

/// The rules that are broken by a scenario whose keys are each in range; none if it can be run.
std::vector<BrokenRule> broken_rules(const Scenario& scenario);

}  // namespace talus::scenario
