#include "dynamics/geometric.h"

#include "core/trigonometry.h"
#include "dynamics/rolling.h"

namespace talus::dynamics {
namespace {

/// Returns a grid with the floor's grains and the boundary.
DiscGrid grid_of(const World& floor, double largest) {
  DiscGrid grid(floor.boundary, largest);
  for (Index i = 0; i < floor.grains.count(); ++i)
    grid.add({floor.grains.x[i], floor.grains.y[i], floor.grains.radius[i]});
  return grid;
}

Vec2 lowest_place(const BedPlan& plan, const GeometricRule& rule, double radius, const DiscGrid& grid,
                  Random& random) {
  const double margin = plan.periodic ? 0.0 : radius;
  const double sine_of_rule = sine(rule.critical_angle);
  Vec2 lowest;
  for (int site = 0; site < rule.sites; ++site) {
    const double x = random.uniform(margin, plan.length - margin);
    const Vec2 place = resting_place(grid, {x, radius, sine_of_rule});
    if (site == 0 || place.y < lowest.y) lowest = place;
  }
  return lowest;
}

}  // namespace

World make_geometric_bed(const BedPlan& plan, const GeometricRule& rule) {
  World floor = empty_bed(plan);
  add_floor(plan, floor);
  DiscGrid grid = grid_of(floor, largest_diameter(plan));
  World world = empty_bed(plan);
  Random random(plan.seed);
  for (Index i = 0; i < plan.grain_count; ++i) {
    const double radius = random_radius(plan, random);
    const Vec2 place = lowest_place(plan, rule, radius, grid, random);
    grid.add({place.x, place.y, radius});
    add_disk(world.grains, place, radius, plan.density, false);
  }
  add_floor(plan, world);
  return world;
}

}  // namespace talus::dynamics
