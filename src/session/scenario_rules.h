#pragma once
/// What the keys of a scenario ask of each other.

#include <string>
#include <vector>

#include "session/scenario.h"

namespace talus {

struct BrokenRule {
  std::vector<std::string> keys;  ///< full names of the keys it is about, most likely to blame first
  std::string expected;           ///< for a message: what was expected, and what was found
};

/// The rules that a scenario breaks whose keys are each in range; none where it can be run.
std::vector<BrokenRule> broken_rules(const Scenario& scenario);

}  // namespace talus
