#pragma once
/// Scenarios of chance that the table of keys allows.

#include <string>
#include <vector>

#include "core/random.h"
#include "scenario/scenario.h"

namespace talus::test {

/// A scenario of a bed of 10 to 20 D by 1 to 10 D, tilted fast, of which some keys have another value that
/// their range allows, the ends of the range favoured. No rule of scenario/rules.h is broken, and its
/// estimate is at most `seconds`. `beds` are files of beds that deposition.file may name.
scenario::Scenario legal_scenario(Random& random, double seconds, const std::vector<std::string>& beds);

}  // namespace talus::test
