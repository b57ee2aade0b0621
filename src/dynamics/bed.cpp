#include "dynamics/bed.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "core/trigonometry.h"

namespace talus {
namespace {

double smallest_diameter(double mean, double size_ratio) { return 2.0 * mean / (1.0 + size_ratio); }

/// <d^2> / <d>^2 of a uniform distribution: 1 + (Dmax - Dmin)^2 / (12 D^2).
double mean_square_ratio(double size_ratio) {
  const double width = smallest_diameter(1.0, size_ratio) * (size_ratio - 1.0);
  return 1.0 + width * width / 12.0;
}

void add_loose_grains(const BedPlan& plan, Grains& grains) {
  const double smallest = smallest_diameter(plan.mean_diameter, plan.size_ratio);
  const double largest = smallest * plan.size_ratio;
  const double fraction =
      std::min(plan.initial_solid_fraction, largest_initial_solid_fraction(plan.size_ratio));
  const double grain_area =
      0.25 * pi * plan.mean_diameter * plan.mean_diameter * mean_square_ratio(plan.size_ratio);
  const auto columns =
      static_cast<Index>(std::max(1.0, std::floor(plan.length / std::sqrt(grain_area / fraction))));
  const double width = plan.length / columns;
  const double height = std::max(grain_area / (fraction * width), largest);
  Random random(plan.seed);
  for (Index i = 0; i < plan.grain_count; ++i) {
    const double radius = 0.5 * random.uniform(smallest, largest);
    const double free_x = std::max(0.0, width - 2.0 * radius);
    const double free_y = std::max(0.0, height - 2.0 * radius);
    const double x = (i % columns) * width + radius + free_x * random.uniform();
    const Index row = i / columns;
    const double y = row * height + radius + free_y * random.uniform();
    add_disk(grains, {x, y}, radius, plan.density, false);
  }
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

}  // namespace

double largest_initial_solid_fraction(double size_ratio) {
  const double largest = smallest_diameter(1.0, size_ratio) * size_ratio;
  return 0.25 * pi * mean_square_ratio(size_ratio) / (largest * largest);
}

World make_bed(const BedPlan& plan) {
  World world;
  world.boundary.periodic = plan.periodic;
  world.boundary.length = plan.length;
  if (!plan.periodic) {
    world.boundary.planes.push_back({.normal = {1.0, 0.0}, .offset = 0.0});
    world.boundary.planes.push_back({.normal = {-1.0, 0.0}, .offset = -plan.length});
  }
  add_loose_grains(plan, world.grains);
  add_floor(plan, world);
  return world;
}

}  // namespace talus
