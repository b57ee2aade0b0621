#include "dynamics/collapse.h"

#include <algorithm>
#include <cmath>

#include "core/trigonometry.h"

namespace talus::dynamics {
namespace {

void add_loose_grains(const BedPlan& plan, double initial_solid_fraction, Grains& grains) {
  const double fraction = std::min(initial_solid_fraction, largest_initial_solid_fraction(plan.size_ratio));
  const double grain_area =
      0.25 * pi * plan.mean_diameter * plan.mean_diameter * mean_square_ratio(plan.size_ratio);
  const auto columns =
      static_cast<Index>(std::max(1.0, std::floor(plan.length / std::sqrt(grain_area / fraction))));
  const double width = plan.length / columns;
  const double height = std::max(grain_area / (fraction * width), largest_diameter(plan));
  Random random(plan.seed);
  for (Index i = 0; i < plan.grain_count; ++i) {
    const double radius = random_radius(plan, random);
    const double free_x = std::max(0.0, width - 2.0 * radius);
    const double free_y = std::max(0.0, height - 2.0 * radius);
    const double x = (i % columns) * width + radius + free_x * random.uniform();
    const Index row = i / columns;
    const double y = row * height + radius + free_y * random.uniform();
    add_disk(grains, {x, y}, radius, plan.density, false);
  }
}

}  // namespace

double largest_initial_solid_fraction(double size_ratio) {
  const double largest = largest_diameter({.mean_diameter = 1.0, .size_ratio = size_ratio});
  return 0.25 * pi * mean_square_ratio(size_ratio) / (largest * largest);
}

World make_loose_bed(const BedPlan& plan, double initial_solid_fraction) {
  World world = empty_bed(plan);
  add_loose_grains(plan, initial_solid_fraction, world.grains);
  add_floor(plan, world);
  return world;
}

}  // namespace talus::dynamics
