#include "dynamics/rolling.h"

#include <optional>

#include "base/errors.h"

namespace talus::dynamics {
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
