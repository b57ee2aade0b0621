#include "dynamics/failure.h"

#include <cmath>

namespace talus {

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

void follow_surface(SurfaceFlow& flow, double velocity, double tilt, double h, double mean_diameter,
                    double gravity) {
  if (flow.failed) return;
  if (!(velocity > flow_velocity * std::sqrt(gravity * mean_diameter))) {
    flow = {};
    return;
  }
  if (!flow.flowing) flow = {.flowing = true, .onset_tilt = tilt};
  flow.displacement += h * velocity;
  flow.failed = flow.displacement >= failure_displacement * mean_diameter;
}

}  // namespace talus
