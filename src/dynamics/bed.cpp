#include "dynamics/bed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "contact/detection.h"
#include "core/trigonometry.h"
#include "dynamics/step.h"

namespace talus::dynamics {

DiscGrid::DiscGrid(const Boundary& boundary, double largest) : boundary_(boundary), height_(largest) {
  columns_ = std::max<Index>(1, static_cast<Index>(std::min(std::floor(boundary.length / largest), 1e8)));
  width_ = boundary.length / columns_;
}

void DiscGrid::add(const PlacedDisc& disc) {
  const Index row = row_of(disc.y), column = std::clamp<Index>(column_of(disc.x), 0, columns_ - 1);
  const std::size_t columns = columns_;
  if (row >= rows_) {
    rows_ = row + 1;
    cells_.resize(static_cast<std::size_t>(rows_) * columns);
  }
  cells_[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)].push_back(
      static_cast<Index>(discs_.size()));
  discs_.push_back(disc);
}

DiscGrid::Touch DiscGrid::first_touch(double x, double radius, double from) const {
  Touch touch;
  for (const Plane& plane : boundary_.planes)
    if (!plane.wall) touch.height = plane.offset + radius;
  const double reach = radius + largest_radius();
  const auto check_disc = [&](Index i) {
    const PlacedDisc& disc = discs_[i];
    const double across = std::fabs(separation(disc.x, x)), distance = radius + disc.radius;
    if (disc.y >= from || across >= distance) return;
    const double height = disc.y + std::sqrt((distance - across) * (distance + across));
    if (height > touch.height) touch = {height, i};
  };
  const double highest = std::min(from, bottom_of(rows_ + 1));
  for (Index row = std::min(row_of(highest), rows_ - 1); row >= 0; --row) {
    visit_rows(row, row, x - reach, x + reach, check_disc);
    if (touch.height >= bottom_of(row) + reach) break;  // no disc of a lower row can stop a grain this high
  }
  return touch;
}

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
  std::vector<Arrival> arrivals(plan.grain_count);
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
  for (std::size_t i = grains.free_count; i < arrivals.size(); ++i)
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
    const auto [radius, x] = arrivals[i];
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

namespace {

constexpr int rounds = 2000;  // each with another detection of contacts
constexpr int sweeps_in_a_round = 10;
constexpr double margin_over_radius = 0.05;  // gap of pairs that may begin to overlap in a round

/// Makes one round: moves grains by their overlaps, and returns the deepest overlap before the round.
double push_overlaps(World& world, const Contacts& contacts, double allowed, std::vector<Vec2>& moved) {
  if (contacts.gap.empty()) return 0.0;
  const double deepest = -std::ranges::min(contacts.gap);
  if (deepest <= allowed) return deepest;
  Grains& grains = world.grains;
  std::vector<Vec2> way(static_cast<std::size_t>(grains.count()) + world.boundary.planes.size());
  for (int sweep = 0; sweep < sweeps_in_a_round; ++sweep)
    for (std::size_t c = 0; c < contacts.a.size(); ++c) {
      Vec2 &a = way[contacts.a[c]], &b = way[contacts.b[c]];
      const double nx = contacts.nx[c], ny = contacts.ny[c];
      const double overlap = -(contacts.gap[c] + nx * (b.x - a.x) + ny * (b.y - a.y));
      if (overlap <= 0.0) continue;
      const double share = contacts.b[c] < grains.free_count ? 0.5 * overlap : overlap;
      a = {a.x - share * nx, a.y - share * ny};
      if (contacts.b[c] < grains.free_count) b = {b.x + share * nx, b.y + share * ny};
    }
  for (Index i = 0; i < grains.free_count; ++i) {
    const std::size_t k = i;
    moved[k] = {moved[k].x + way[k].x, moved[k].y + way[k].y};
    grains.x[i] += way[k].x;
    grains.y[i] += way[k].y;
    const double length = world.boundary.length;
    if (world.boundary.periodic) grains.x[i] -= length * std::floor(grains.x[i] / length);
    if (world.boundary.periodic && grains.x[i] >= length)
      grains.x[i] = 0.0;  // a value just below 0 was rounded up to the period
  }
  return deepest;
}

}  // namespace

Displacement push_apart(World& world, double allowed) {
  std::vector<Vec2> moved(world.grains.free_count);
  if (moved.empty()) return {};
  const double margin = margin_over_radius * std::ranges::max(world.grains.radius);
  contact::NeighbourList list;
  Contacts contacts;
  for (int round = 0; round < rounds; ++round) {
    contact::detect_contacts(list, world.grains, world.boundary, margin, contacts);
    if (push_overlaps(world, contacts, allowed, moved) <= allowed) break;
  }
  Displacement displacement;
  for (const Vec2 way : moved) {
    const double distance = std::sqrt(way.x * way.x + way.y * way.y);
    displacement.mean += distance / static_cast<double>(moved.size());
    displacement.largest = std::max(displacement.largest, distance);
  }
  return displacement;
}

}  // namespace talus::dynamics
