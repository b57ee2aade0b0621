#include <algorithm>
#include <cmath>
#include <optional>

#include "base/errors.h"
#include "dynamics/step.h"

namespace talus::dynamics {

namespace {

/// Contacts first ... last - 1, the part of one member of a team.
struct Part {
  std::size_t first, last;
};

template <typename Value>
void copy(const std::vector<Value>& from, Part part, std::vector<Value>& to) {
  std::copy(from.data() + part.first, from.data() + part.last, to.data() + part.first);
}

void fill(std::vector<double>& values, Part part, double value) {
  std::fill(values.data() + part.first, values.data() + part.last, value);
}

/// Sizes the arrays of bodies, including the planes, which never move.
void size_bodies(const World& world, solver::ContactProblem& problem) {
  const std::size_t grains = world.grains.count();
  for (auto* field : {&problem.vx, &problem.vy, &problem.omega, &problem.inverse_mass,
                      &problem.inverse_inertia, &problem.lever}) {
    field->resize(grains);
    field->resize(grains + world.boundary.planes.size(), 0.0);
  }
}

/// Copies the grains: free velocities, and the masses, inertias and radii of the Delassus operator (T8).
void take_grains(const World& world, double h, solver::ContactProblem& problem) {
  const Grains& grains = world.grains;
  const Part all{0, static_cast<std::size_t>(grains.count())};
  const Vec2 gravity = gravity_vector(world);
  const Vec2 fall{h * gravity.x, h * gravity.y};
  for (std::size_t i = all.first; i < all.last; ++i) {
    const bool moves = grains.inverse_mass[i] > 0.0;
    const double vx = grains.vx[i] + fall.x;  // (T4)
    const double vy = grains.vy[i] + fall.y;
    problem.vx[i] = moves ? vx : 0.0;
    problem.vy[i] = moves ? vy : 0.0;
  }
  copy(grains.omega, all, problem.omega);
  copy(grains.inverse_mass, all, problem.inverse_mass);
  copy(grains.inverse_inertia, all, problem.inverse_inertia);
  copy(grains.radius, all, problem.lever);
}

/// Returns the number of columns of a bed with this number of contacts.
Index columns_of(const World& world, Index contacts) {
  constexpr Index contacts_for_columns = 24'000;
  constexpr double width_of_column = 4.0;  // in diameters of the largest grain
  if (contacts < contacts_for_columns) return 0;
  const std::vector<double>& radius = world.grains.radius;
  const double largest = 2.0 * *std::max_element(radius.begin(), radius.end());
  const double columns = std::floor(world.boundary.length / (width_of_column * largest));
  return columns >= 1.0 ? static_cast<Index>(std::min(columns, static_cast<double>(radius.size()))) : 0;
}

void size_columns(const World& world, Index contacts, solver::ContactProblem& problem) {
  problem.columns = columns_of(world, contacts);
  problem.column.resize(problem.columns > 0 ? problem.vx.size() : 0);
}

void take_columns(const World& world, solver::ContactProblem& problem) {
  if (problem.columns == 0) return;
  const std::vector<double>& x = world.grains.x;
  const double last = problem.columns - 1.0, columns_per_metre = problem.columns / world.boundary.length;
  for (std::size_t i = 0; i < x.size(); ++i) {
    // A position of NaN gets column 0, so that the step can detect and report it.
    const double at = x[i] * columns_per_metre;
    problem.column[i] = at > 0.0 ? static_cast<Index>(std::min(at, last)) : 0;
  }
  std::fill(problem.column.begin() + static_cast<std::ptrdiff_t>(x.size()), problem.column.end(),
            0);  // planes
}

/// Sizes the arrays of contacts. Assignments would allocate each time that the number of contacts grows.
void size_contacts(const Contacts& contacts, const ContactLawParameters& law,
                   solver::ContactProblem& problem) {
  const std::size_t count = contacts.a.size();
  for (auto* field : {&problem.a, &problem.b}) field->resize(count);
  for (auto* field : {&problem.nx, &problem.ny, &problem.cn, &problem.ct, &problem.mu}) field->resize(count);
  problem.rolling_friction.resize(law.rolling_friction != 0.0 ? count : 0);
}

void take_local_frames(const Contacts& contacts, Part part, solver::ContactProblem& problem) {
  copy(contacts.a, part, problem.a);
  copy(contacts.b, part, problem.b);
  copy(contacts.nx, part, problem.nx);
  copy(contacts.ny, part, problem.ny);
}

/// Returns the relative velocity at contact c before the step.
solver::RelativeVelocity velocity_before(const Grains& grains, const Contacts& contacts, Index c) {
  const Index a = contacts.a[c];
  const Index b = contacts.b[c];
  const bool plane = b >= grains.count();
  const double dvx = (plane ? 0.0 : grains.vx[b]) - grains.vx[a];
  const double dvy = (plane ? 0.0 : grains.vy[b]) - grains.vy[a];
  const double spin = grains.radius[a] * grains.omega[a] + (plane ? 0.0 : grains.radius[b] * grains.omega[b]);
  return {dvx * contacts.nx[c] + dvy * contacts.ny[c], dvy * contacts.nx[c] - dvx * contacts.ny[c] - spin};
}

double free_normal_velocity(const solver::ContactProblem& problem, Index c) {
  const Index a = problem.a[c];
  const Index b = problem.b[c];
  return (problem.vx[b] - problem.vx[a]) * problem.nx[c] + (problem.vy[b] - problem.vy[a]) * problem.ny[c];
}

/// Returns the error of an impulse that the tolerance of a solve allows: the tolerance times the rms of the
/// remembered impulses.
double impulse_of_noise(const Contacts& contacts, double h, double tolerance) {
  double sum = 0.0;
  Index bearing = 0;
  for (Index c = 0; c < contacts.count(); ++c) {
    const double fn = contacts.fn[c], ft = contacts.ft[c];
    sum += fn * fn + ft * ft;
    bearing += fn > 0.0 ? 1 : 0;
  }
  return bearing > 0 ? tolerance * h * std::sqrt(sum / bearing) : 0.0;
}

/// Sets c_n by (T11). A gap or an overlap of a contact that bears load is an error of the solver. Correcting
/// all of them at once would demand velocities of closed loops of contacts that no motion of rigid bodies
/// has: forces would drift along self-stresses, and the solve would not converge. They are therefore
/// corrected no faster than they arise.
void set_gap_velocities(const Contacts& contacts, const ContactLawParameters& law, double h, double noise,
                        Part part, solver::ContactProblem& problem) {
  const double allowed = law.allowed_overlap, share = law.overlap_correction;
  // Larger gaps and overlaps are not noise. The limit of gaps is small, because gaps also open when grains
  // move past each other.
  const double gap_of_noise = 0.05 * allowed, overlap_of_noise = 10.0 * allowed;
  for (std::size_t c = part.first; c < part.last; ++c) {
    const double gap = contacts.gap[c], overlap = -gap;
    double& cn = problem.cn[c];
    if (gap > 0.0 ? contacts.fn[c] == 0.0 : overlap <= allowed) {
      cn = std::max(0.0, gap) / h;
      continue;
    }
    const double slowly = noise * solver::delassus_diagonal(problem, c).normal;
    if (gap > 0.0)
      cn = std::max(std::min(gap / h, slowly), (gap - gap_of_noise) / h);
    else
      cn = -std::max(std::min(share * ((overlap - allowed) / h), slowly),
                     share * ((overlap - overlap_of_noise) / h));
  }
}

/// Applies restitution (T12).
void set_restitution(const World& world, const Contacts& contacts, const ContactLawParameters& law, double h,
                     solver::ContactProblem& problem) {
  for (Index c = 0; c < contacts.count(); ++c) {
    const bool closes = contacts.gap[c] + h * free_normal_velocity(problem, c) <= 0.0;
    if (!closes) continue;
    const solver::RelativeVelocity before = velocity_before(world.grains, contacts, c);
    if (before.normal < 0.0) problem.cn[c] = std::min(problem.cn[c], law.restitution * before.normal);
    problem.ct[c] = law.tangential_restitution * before.tangential;
  }
}

bool touches_wall(const World& world, const Contacts& contacts, std::size_t c) {
  const Index plane = contacts.b[c] - world.grains.count();
  return plane >= 0 && world.boundary.planes[plane].wall;
}

void set_friction(const World& world, const Contacts& contacts, const ContactLawParameters& law, Part part,
                  solver::ContactProblem& problem) {
  fill(problem.mu, part, law.friction);
  if (world.boundary.planes.empty()) return;
  for (std::size_t c = part.first; c < part.last; ++c)
    if (touches_wall(world, contacts, c)) problem.mu[c] = law.wall_friction;
}

/// Sets mu_r. Side walls do not resist rolling.
void set_rolling_friction(const World& world, const Contacts& contacts, const ContactLawParameters& law,
                          Part part, solver::ContactProblem& problem) {
  if (law.rolling_friction == 0.0) return;
  fill(problem.rolling_friction, part, law.rolling_friction);
  for (std::size_t c = part.first; c < part.last; ++c)
    if (touches_wall(world, contacts, c)) problem.rolling_friction[c] = 0.0;
}

}  // namespace

void form_problem(const World& world, const Contacts& contacts, const ContactLawParameters& law, double h,
                  double tolerance, solver::ContactProblem& problem, ThreadTeam* team) {
  size_bodies(world, problem);
  size_contacts(contacts, law, problem);
  size_columns(world, contacts.count(), problem);
  double noise = 0.0;
  // The sum of the noise is one chain of additions, in an order that must not depend on the team.
  run_both(
      team, [&] { noise = impulse_of_noise(contacts, h, tolerance); },
      [&] {
        take_grains(world, h, problem);
        take_columns(world, problem);
      });
  distribute(team, contacts.a.size(), [&](std::size_t first, std::size_t last) {
    const Part part{first, last};
    take_local_frames(contacts, part, problem);
    set_gap_velocities(contacts, law, h, noise, part, problem);
    fill(problem.ct, part, 0.0);
    set_friction(world, contacts, law, part, problem);
    set_rolling_friction(world, contacts, law, part, problem);
  });
  if (law.restitution != 0.0 || law.tangential_restitution != 0.0)
    set_restitution(world, contacts, law, h, problem);
}

namespace {

constexpr int max_moves = 1'000'000;  // falls and rolls of one grain; a tower of grains needs some hundreds

/// A grain rolling on a disc. Its centre moves on a circle about that of the disc, from `direction` down to
/// the equator. Positions are relative to the centre of the disc, so that they are equally precise
/// everywhere.
struct Roll {
  Index on = DiscGrid::none;
  double reach = 0.0;  ///< m, radius of the circle, the sum of the radii of disc and grain
  Vec2 direction;      ///< unit, from the centre of the disc to that of the grain
  double side = 1.0;   ///< side of the disc on which the grain rolls down: 1 right, -1 left
};

/// Point of its circle at which the rolling grain touches another body.
struct Stop {
  Vec2 direction;
  Index disc = DiscGrid::none;  ///< disc that is touched; none: a wall or the plane floor
  bool holds = true;            ///< whether the body stops the grain; else the grain continues over the disc
};

double component(double other) { return std::sqrt(std::max(0.0, (1.0 - other) * (1.0 + other))); }

double square(Vec2 v) { return v.x * v.x + v.y * v.y; }

/// Whether a rolling grain reaches `first` before `second`, or both are equal.
bool is_before(Vec2 first, Vec2 second, double side) {
  return side * (first.x * second.y - first.y * second.x) <= 0.0;
}

class Path {
 public:
  Path(const DiscGrid& bed, const FallingGrain& grain) : bed_(bed), grain_(grain), x_(grain.x) {}

  Vec2 end() {
    for (int move = 0; move < max_moves; ++move)
      if (const std::optional<Vec2> place = roll_ ? continue_rolling() : fall()) return *place;
    throw Error(ExitCode::internal, "the position of rest of a grain was not found");
  }

 private:
  double reach(Index disc) const { return grain_.radius + bed_[disc].radius; }

  /// Returns the centre of the grain in a direction from that of a disc.
  Vec2 place(Index disc, Vec2 direction) const {
    double x = bed_[disc].x + reach(disc) * direction.x;
    const Boundary& boundary = bed_.boundary();
    if (boundary.periodic) {
      x -= boundary.length * std::floor(x / boundary.length);
      if (x >= boundary.length) x = 0.0;  // a value just below 0 was rounded up to the period
    }
    return {x, bed_[disc].y + reach(disc) * direction.y};
  }

  std::optional<Vec2> fall() {
    const DiscGrid::Touch touch = bed_.first_touch(x_, grain_.radius, height_);
    if (touch.disc == DiscGrid::none) return Vec2{x_, touch.height};
    const double across = bed_.separation(bed_[touch.disc].x, x_) / reach(touch.disc);
    const Vec2 direction{across, component(across)};
    if (grain_.critical_sine > 0.0 && std::fabs(across) <= grain_.critical_sine)
      return place(touch.disc, direction);
    roll_ = Roll{touch.disc, reach(touch.disc), direction, across < 0.0 ? -1.0 : 1.0};
    return std::nullopt;
  }

  std::optional<Vec2> continue_rolling() {
    const Roll roll = *roll_;
    const std::optional<Stop> stop = first_stop(roll);
    if (!stop) {
      const Vec2 equator = place(roll.on, {roll.side, 0.0});
      x_ = equator.x;
      height_ = equator.y;
      roll_.reset();
      return std::nullopt;
    }
    if (stop->holds) return place(roll.on, stop->direction);
    const Vec2 to_disc = from_to(roll.on, stop->disc);
    const double next_reach = reach(stop->disc);
    roll_->on = stop->disc;
    roll_->reach = next_reach;
    roll_->direction = {(roll.reach * stop->direction.x - to_disc.x) / next_reach,
                        (roll.reach * stop->direction.y - to_disc.y) / next_reach};
    return std::nullopt;
  }

  Vec2 from_to(Index disc, Index other) const {
    return {bed_.separation(bed_[disc].x, bed_[other].x), bed_[other].y - bed_[disc].y};
  }

  std::optional<Stop> first_stop(const Roll& roll) const {
    std::optional<Stop> first;
    const auto take = [&](const std::optional<Stop>& stop) {
      if (stop && (!first || !is_before(first->direction, stop->direction, roll.side))) first = stop;
    };
    const PlacedDisc& on = bed_[roll.on];
    const double around = grain_.radius + bed_.largest_radius();
    const double from = on.x + roll.reach * roll.direction.x, to = on.x + roll.reach * roll.side;
    const double top = on.y + roll.reach * roll.direction.y;
    bed_.visit({std::min(from, to) - around, on.y - around}, {std::max(from, to) + around, top + around},
               [&](Index disc) {
                 if (disc != roll.on) take(stop_at_disc(roll, disc));
               });
    for (const Plane& plane : bed_.boundary().planes)
      take(plane.wall ? stop_at_wall(roll, plane) : stop_at_floor(roll, plane));
    return first;
  }

  /// Returns the stop of the grain at another disc. The circles on which its centre touches each of the discs
  /// intersect at the angle alpha to the line between their centres, on the side from which the grain comes.
  std::optional<Stop> stop_at_disc(const Roll& roll, Index disc) const {
    const Vec2 to_disc = from_to(roll.on, disc);
    const double distance = std::sqrt(square(to_disc)), other = reach(disc);
    if (distance >= roll.reach + other) return std::nullopt;
    const double cosine =
        (roll.reach * roll.reach + (distance - other) * (distance + other)) / (2.0 * roll.reach * distance);
    const double sine = roll.side * component(cosine);
    const Vec2 along{to_disc.x / distance, to_disc.y / distance};
    const Stop stop{{along.x * cosine - along.y * sine, along.y * cosine + along.x * sine},
                    disc,
                    roll.side * (to_disc.x - roll.reach * (along.x * cosine - along.y * sine)) > 0.0};
    return is_ahead(roll, stop.direction) || is_touching(roll, to_disc, stop.direction) ? std::optional(stop)
                                                                                        : std::nullopt;
  }

  static bool is_ahead(const Roll& roll, Vec2 direction) {
    return direction.y >= 0.0 && roll.side * direction.x >= 0.0 &&
           is_before(roll.direction, direction, roll.side);
  }

  /// Whether the grain already touches a disc towards which it rolls: it has passed the point of contact by
  /// round-off, which is magnified to its square root if the circles are nearly tangent.
  static bool is_touching(const Roll& roll, Vec2 to_disc, Vec2 meeting) {
    constexpr double round_off = 1e-5;
    const Vec2 here = roll.direction;
    const bool towards = roll.side * (here.y * to_disc.x - here.x * to_disc.y) > 0.0;
    return towards && std::fabs(here.x * meeting.y - here.y * meeting.x) < round_off &&
           here.x * meeting.x + here.y * meeting.y > 0.0;
  }

  std::optional<Stop> stop_at_wall(const Roll& roll, const Plane& wall) const {
    if (wall.normal.x * roll.side > 0.0) return std::nullopt;  // the wall behind
    const double x = wall.normal.x * wall.offset + wall.normal.x * grain_.radius;
    const double across = (x - bed_[roll.on].x) / roll.reach;
    if (std::fabs(across) > 1.0) return std::nullopt;
    return Stop{{across, component(across)}};
  }

  std::optional<Stop> stop_at_floor(const Roll& roll, const Plane& floor) const {
    const double up = (floor.offset + grain_.radius - bed_[roll.on].y) / roll.reach;
    if (up < 0.0) return std::nullopt;
    return Stop{{roll.side * component(up), up}};
  }

  const DiscGrid& bed_;
  const FallingGrain& grain_;
  double x_;                                                 ///< m, position at which the grain falls
  double height_ = std::numeric_limits<double>::infinity();  ///< m, height from which it falls
  std::optional<Roll> roll_;                                 ///< empty while it falls
};

}  // namespace

Vec2 resting_place(const DiscGrid& bed, const FallingGrain& grain) { return Path(bed, grain).end(); }

}  // namespace talus::dynamics
