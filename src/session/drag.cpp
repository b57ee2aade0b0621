#include "session/drag.h"

#include <algorithm>
#include <cmath>

namespace talus::session {
namespace {

constexpr double longest_step = 0.25;  // 1 / w

}  // namespace

Vec2 drag_offset(const Drag& drag, const World& world) {
  return {offset_along(world.boundary, world.grains.x[drag.grain], drag.x),
          drag.y - world.grains.y[drag.grain]};
}

Vec2 drag_acceleration(const Drag& drag, double mean_diameter, double h, const World& world) {
  const double w = std::min(std::sqrt(drag_stiffness * world.gravity / mean_diameter), longest_step / h);
  const Vec2 way = drag_offset(drag, world);
  return {w * (w * way.x - 2.0 * world.grains.vx[drag.grain]),
          w * (w * way.y - 2.0 * world.grains.vy[drag.grain])};
}

void pull(const Drag& drag, double mean_diameter, double h, World& world) {
  const Vec2 acceleration = drag_acceleration(drag, mean_diameter, h, world);
  world.grains.vx[drag.grain] += h * acceleration.x;
  world.grains.vy[drag.grain] += h * acceleration.y;
}

}  // namespace talus::session
