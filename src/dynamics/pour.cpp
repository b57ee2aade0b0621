#include "dynamics/pour.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dynamics/disc_grid.h"

namespace talus {
namespace {

/// Discs by where they are along the bed, so that a falling grain meets only those near its line.
class DiscColumns {
 public:
  /// `reach`: the largest diameter, m.
  DiscColumns(const World& world, double reach) : boundary_(world.boundary) {
    count_ = std::max<Index>(1, static_cast<Index>(std::min(std::floor(boundary_.length / reach), 1e8)));
    discs_.resize(static_cast<std::size_t>(count_));
    const Grains& grains = world.grains;
    for (Index i = 0; i < grains.count(); ++i) add({grains.x[i], grains.y[i], grains.radius[i]});
  }

  void add(const PlacedDisc& disc) { discs_[static_cast<std::size_t>(column_of(disc.x))].push_back(disc); }

  /// Height at which a grain that falls along x first touches, m.
  double first_touch(double x, double radius) const {
    double height = -std::numeric_limits<double>::infinity();
    for (const Plane& plane : boundary_.planes)
      if (!plane.wall) height = plane.offset + radius;
    const Index column = column_of(x);
    // With fewer than three columns the neighbours on both sides are the same.
    const Index first = count_ < 3 ? 0 : column - 1, last = count_ < 3 ? count_ - 1 : column + 1;
    for (Index k = first; k <= last; ++k)
      if (boundary_.periodic || (k >= 0 && k < count_)) meet((k + count_) % count_, x, radius, height);
    return height;
  }

 private:
  Index column_of(double x) const {
    const double column = std::floor(x / boundary_.length * count_);
    return static_cast<Index>(std::clamp(column, 0.0, static_cast<double>(count_ - 1)));
  }

  void meet(Index column, double x, double radius, double& height) const {
    for (const PlacedDisc& disc : discs_[static_cast<std::size_t>(column)]) {
      double dx = disc.x - x;
      if (boundary_.periodic) dx = std::remainder(dx, boundary_.length);
      const double distance = radius + disc.radius;
      if (std::fabs(dx) < distance)
        height = std::max(height, disc.y + std::sqrt(distance * distance - dx * dx));
    }
  }

  const Boundary& boundary_;
  Index count_ = 1;
  std::vector<std::vector<PlacedDisc>> discs_;
};

/// Puts free grains behind those that there are, before the floor's.
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

Grains with_all_arrivals(Grains grains, std::span<const Arrival> arrivals, double density) {
  Grains waiting;
  for (auto i = static_cast<std::size_t>(grains.free_count); i < arrivals.size(); ++i)
    add_disk(waiting, {arrivals[i].x, 0.0}, arrivals[i].radius, density, false);
  insert_free_grains(waiting, grains);
  return grains;
}

void let_arrive(std::span<const Arrival> arrivals, const PourRule& rule, double h, World& world) {
  const Index first = world.grains.free_count;
  const Index due = arrived_by(world.time, rule, static_cast<Index>(arrivals.size()));
  if (due <= first) return;
  double largest = 0.0;
  for (const double radius : world.grains.radius) largest = std::max(largest, radius);
  for (Index i = first; i < due; ++i)
    largest = std::max(largest, arrivals[static_cast<std::size_t>(i)].radius);
  DiscColumns columns(world, 2.0 * largest);
  Grains arrived;
  for (Index i = first; i < due; ++i) {
    const auto [radius, x] = arrivals[static_cast<std::size_t>(i)];
    const double y = columns.first_touch(x, radius) + 0.5 * h * rule.speed;
    const Index grain = add_disk(arrived, {x, y}, radius, rule.density, false);
    arrived.vy[grain] = -rule.speed;
    columns.add({x, y, radius});  // those that arrive together meet each other too
  }
  insert_free_grains(arrived, world.grains);
  for (Index& body : world.contacts.b)  // a is a free grain always
    if (body >= first) body += arrived.count();
}

}  // namespace talus
