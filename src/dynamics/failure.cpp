#include "dynamics/failure.h"

#include <algorithm>
#include <cmath>

namespace talus::dynamics {

double surface_velocity(const Grains& grains, double lower_edge) {
  double sum = 0.0;
  Index count = 0;
  for (Index i = 0; i < grains.free_count; ++i) {
    if (grains.y[i] <= lower_edge) continue;
    sum += grains.vx[i];
    ++count;
  }
  return count > 0 ? sum / count : 0.0;
}

FlowRule flow_rule(double mean_diameter, double gravity, const Boundary& boundary) {
  const double distance = 5.0 * mean_diameter;
  return {.velocity = 0.02 * std::sqrt(gravity * mean_diameter),
          .distance = boundary.periodic ? distance : std::min(distance, boundary.length / 20.0)};
}

void follow_surface(SurfaceFlow& flow, double velocity, double tilt, double h, const FlowRule& rule) {
  if (flow.failed) return;
  if (!(velocity > rule.velocity)) {
    flow = {};
    return;
  }
  if (!flow.flowing) flow = {.flowing = true, .onset_tilt = tilt};
  flow.displacement += h * velocity;
  flow.failed = flow.displacement >= rule.distance;
}

}  // namespace talus::dynamics
