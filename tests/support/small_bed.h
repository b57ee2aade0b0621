#pragma once
/// A bed so small that a run of it takes some ten milliseconds.

#include "session/scenario.h"

namespace talus::test {

/// 30 grains on a rough floor, soon called at rest; what differs from test to test is the tilt.
inline Scenario small_bed() {
  Scenario scenario;
  scenario.bed.length = 10.0;
  scenario.bed.depth = 3.0;
  scenario.deposition.rest_velocity = 0.1;
  return scenario;
}

}  // namespace talus::test
