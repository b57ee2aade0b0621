#pragma once
/// Very small bed, for runs that take some ten milliseconds.

#include "scenario/scenario.h"

namespace talus::test {

/// Returns 30 grains that collapse onto a rough floor and soon count as at rest; tests differ in the tilt.
inline scenario::Scenario small_bed() {
  scenario::Scenario scenario;
  scenario.bed.length = 10.0;
  scenario.bed.depth = 3.0;
  scenario.deposition.method = scenario::DepositionMethod::collapse;
  scenario.deposition.rest_velocity = 0.1;
  return scenario;
}

/// Returns the same bed, tilted to `end_angle` (deg) by 0.4 deg per step.
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
