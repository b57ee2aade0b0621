#include "dynamics/pour.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus::dynamics {
namespace {

/// Returns the height of the centre, m, at which a disk that falls along the vertical line at x first touches
/// one of `grains`; -infinity if it touches none.
double first_touch(const Grains& grains, const Boundary& boundary, double x, double radius) {
  double height = -std::numeric_limits<double>::infinity();
  const double half = boundary.periodic ? 0.5 * boundary.length : std::numeric_limits<double>::infinity();
  for (Index i = 0; i < grains.count(); ++i) {
    double dx = std::fabs(grains.x[i] - x);
    if (dx > half) dx = boundary.length - dx;  // across the periodic edge
    const double distance = radius + grains.radius[i];
    if (dx < distance) height = std::max(height, grains.y[i] + std::sqrt(distance * distance - dx * dx));
  }
  return height;
}

/// Returns the height of the centre, m, at which a disk first touches the floor, if that is a plane;
/// -infinity otherwise.
double first_touch(const std::vector<Plane>& planes, double radius) {
  double height = -std::numeric_limits<double>::infinity();
  for (const Plane& plane : planes)
    if (!plane.wall) height = plane.offset + radius;
  return height;
}

/// Inserts free grains after the existing ones, before those of the floor.
void insert_free_grains(const Grains& arrived, Grains& grains) {
  const Index first = grains.free_count;
  const auto insert = [first](auto& to, const auto& from) {
    to.insert(to.begin() + first, from.begin(), from.end());
  };
  for (std::vector<double> Grains::*field :
       {&Grains::x, &Grains::y, &Grains::vx, &Grains::vy, &Grains::omega, &Grains::radius,
        &Grains::inverse_mass, &Grains::inverse_inertia, &Grains::mass, &Grains::inertia, &Grains::angle})
    insert(grains.*field, arrived.*field);
  insert(grains.image, arrived.image);
  grains.free_count += arrived.count();
}

}  // namespace

std::vector<Arrival> pour_arrivals(const BedPlan& plan) {
  std::vector<Arrival> arrivals(static_cast<std::size_t>(plan.grain_count));
  Random random(plan.seed);
  for (Arrival& arrival : arrivals) {
    arrival.radius = random_radius(plan, random);
    const double margin = plan.periodic ? 0.0 : arrival.radius;
    arrival.x = random.uniform(margin, plan.length - margin);
  }
  return arrivals;
}

Index arrived_by(double time, const PourRule& rule, Index count) {
  const double whole = std::floor(time / rule.interval);
  return whole + 1.0 >= count ? count : static_cast<Index>(whole) + 1;
}

Grains with_remaining_grains(Grains grains, std::span<const Arrival> arrivals, double density) {
  Grains waiting;
  for (auto i = static_cast<std::size_t>(grains.free_count); i < arrivals.size(); ++i)
    add_disk(waiting, {arrivals[i].x, 0.0}, arrivals[i].radius, density, false);
  insert_free_grains(waiting, grains);
  return grains;
}

void add_due_grains(std::span<const Arrival> arrivals, const PourRule& rule, double h, World& world) {
  const Index first = world.grains.free_count;
  const Index due = arrived_by(world.time, rule, static_cast<Index>(arrivals.size()));
  if (due <= first) return;
  Grains arrived;
  for (Index i = first; i < due; ++i) {
    const auto [radius, x] = arrivals[static_cast<std::size_t>(i)];
    // Grains that arrive together can touch each other too.
    const double touch = std::max({first_touch(world.boundary.planes, radius),
                                   first_touch(world.grains, world.boundary, x, radius),
                                   first_touch(arrived, world.boundary, x, radius)});
    const Index grain = add_disk(arrived, {x, touch + 0.5 * h * rule.speed}, radius, rule.density, false);
    arrived.vy[grain] = -rule.speed;
  }
  insert_free_grains(arrived, world.grains);
  for (Index& body : world.contacts.b)  // a is always a free grain
    if (body >= first) body += arrived.count();
}

}  // namespace talus::dynamics
