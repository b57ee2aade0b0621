#include "dynamics/bed.h"

#include <cmath>

namespace talus::dynamics {
namespace {

double smallest_over_mean(double size_ratio) { return 2.0 / (1.0 + size_ratio); }

}  // namespace

double smallest_diameter(const BedPlan& plan) { return 2.0 * plan.mean_diameter / (1.0 + plan.size_ratio); }

double largest_diameter(const BedPlan& plan) { return smallest_diameter(plan) * plan.size_ratio; }

double random_radius(const BedPlan& plan, Random& random) {
  return 0.5 * random.uniform(smallest_diameter(plan), largest_diameter(plan));
}

double mean_square_ratio(double size_ratio) {
  const double width = smallest_over_mean(size_ratio) * (size_ratio - 1.0);
  return 1.0 + width * width / 12.0;
}

World empty_bed(const BedPlan& plan) {
  World world;
  world.boundary.periodic = plan.periodic;
  world.boundary.length = plan.length;
  if (!plan.periodic) {
    world.boundary.planes.push_back({.normal = {1.0, 0.0}, .offset = 0.0});
    world.boundary.planes.push_back({.normal = {-1.0, 0.0}, .offset = -plan.length});
  }
  return world;
}

void add_floor(const BedPlan& plan, World& world) {
  if (!plan.rough_floor) {
    world.boundary.planes.push_back({.normal = {0.0, 1.0}, .offset = 0.0, .wall = false});
    return;
  }
  const auto count = static_cast<Index>(std::floor(plan.length / plan.mean_diameter + 1e-9));
  const double spacing = plan.length / count;
  for (Index i = 0; i < count; ++i)
    add_disk(world.grains, {(i + 0.5) * spacing, -0.5 * plan.mean_diameter}, 0.5 * plan.mean_diameter,
             plan.density, true);
}

}  // namespace talus::dynamics
