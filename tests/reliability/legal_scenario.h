#pragma once
/// Random scenarios that the table of keys allows.

#include <string>
#include <vector>

#include "core/random.h"
#include "scenario/scenario.h"

namespace talus::test {

/// Returns a scenario of a bed of 10 to 20 D by 1 to 10 D, tilted fast, with random values of some keys
/// within their ranges, preferably at the ends. It breaks no rule of scenario/rules.h, and its estimate is at
/// most `seconds`. `beds` are bed files that deposition.file may name.
scenario::Scenario legal_scenario(Random& random, double seconds, const std::vector<std::string>& beds);

}  // namespace talus::test
