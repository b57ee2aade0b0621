#pragma once
/// A bed so small that a run of it takes some ten milliseconds.

#include "scenario/scenario.h"

namespace talus::test {

/// 30 grains that collapse onto a rough floor, soon called at rest; what differs from test to test is the
/// tilt.
inline scenario::Scenario small_bed() {
  scenario::Scenario scenario;
  scenario.bed.length = 10.0;
  scenario.bed.depth = 3.0;
  scenario.deposition.method = scenario::DepositionMethod::collapse;
  scenario.deposition.rest_velocity = 0.1;
  return scenario;
}

/// The same, tilted to `end_angle` (deg) by 0.4 deg a step.
inline scenario::Scenario small_tilted_bed(double end_angle) {
  scenario::Scenario scenario = small_bed();
  scenario.tilt.rate = 20.0;
  scenario.tilt.step = 0.02;
  scenario.tilt.end_angle = end_angle;
  scenario.output.frame_every = 0.5;
  scenario.output.observable_every = 0.2;
  return scenario;
}

}  // namespace talus::test
