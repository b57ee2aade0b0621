#pragma once
/// Beds: the plan of a bed (sizes of its grains, floor, boundary), and the methods of deposition.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/random.h"
#include "core/types.h"
#include "core/world.h"

namespace talus::dynamics {

// Discs sorted by position, so that a falling or rolling grain is compared only with nearby ones.

/// A disc; lengths in m.
struct PlacedDisc {
  double x = 0.0, y = 0.0, radius = 0.0;
};

/// A grid of discs in square cells as wide as the largest disc. A periodic bed must be longer than four
/// cells.
class DiscGrid {
 public:
  static constexpr Index none = -1;

  /// First contact of a falling grain.
  struct Touch {
    double height = -std::numeric_limits<double>::infinity();  ///< m, height of the centre of the grain
    Index disc = none;  ///< disc that is touched; none: the plane floor
  };

  /// Creates a grid for discs with diameters up to `largest`, m. No centre may be more than `largest` below
  /// 0.
  DiscGrid(const Boundary& boundary, double largest);

  void add(const PlacedDisc& disc);
  const PlacedDisc& operator[](Index disc) const { return discs_[disc]; }
  const Boundary& boundary() const { return boundary_; }
  double largest_radius() const { return 0.5 * height_; }

  /// Returns the distance from one x to another, m; in a periodic bed the shorter one.
  double separation(double from, double to) const {
    return boundary_.periodic ? std::remainder(to - from, boundary_.length) : to - from;
  }

  /// Returns the first contact of a grain whose centre falls along the vertical line at x from the height
  /// `from`, m, with the plane floor and with the discs whose centres are below `from`.
  Touch first_touch(double x, double radius, double from) const;

  /// Calls visit(disc) for each disc with its centre in a rectangle, and for some discs near it.
  template <typename Visit>
  void visit(Vec2 low, Vec2 high, Visit visit) const {
    visit_rows(std::max<Index>(0, row_of(low.y)), std::min(row_of(high.y), rows_ - 1), low.x, high.x, visit);
  }

 private:
  // The first row is that of the floor grains, below 0.
  Index row_of(double y) const { return static_cast<Index>(std::floor(y / height_)) + 1; }
  double bottom_of(Index row) const { return (row - 1) * height_; }
  Index column_of(double x) const { return static_cast<Index>(std::floor(x / width_)); }
  const std::vector<Index>& cell(Index row, Index column) const {
    const Index wrapped = (column % columns_ + columns_) % columns_;
    return cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(wrapped)];
  }

  template <typename Visit>
  void visit_rows(Index bottom, Index top, double x_low, double x_high, Visit visit) const {
    Index first = column_of(x_low), last = column_of(x_high);
    if (!boundary_.periodic) {
      first = std::max<Index>(0, first);
      last = std::min(last, columns_ - 1);
    }
    last = std::min(last, first + columns_ - 1);
    for (Index row = bottom; row <= top; ++row)
      for (Index column = first; column <= last; ++column)
        for (const Index disc : cell(row, column)) visit(disc);
  }

  Boundary boundary_;
  double height_ = 0.0, width_ = 0.0;  ///< size of a cell, m
  Index columns_ = 1, rows_ = 0;
  std::vector<PlacedDisc> discs_;
  std::vector<std::vector<Index>> cells_;
};

/// Plan of a bed. Lengths are in m.
struct BedPlan {
  double mean_diameter = 0.01;
  double size_ratio = 1.5;  ///< Dmax / Dmin; diameters are uniform in [Dmin, Dmax]
  double density = 2500.0;  ///< kg/m^3
  double length = 2.0;      ///< period, or distance between the walls
  Index grain_count = 8000;
  bool periodic = true;
  bool rough_floor =
      true;  ///< glued grains of the mean diameter with their tops at y = 0; else the plane y = 0
  std::uint64_t seed = 1;
};

/// Return the diameters of the smallest and of the largest grain, m.
double smallest_diameter(const BedPlan& plan);
double largest_diameter(const BedPlan& plan);

/// Draws the radius of the next grain, m.
double random_radius(const BedPlan& plan, Random& random);

/// Returns <d^2> / <d>^2 of the diameters, 1 + (Dmax - Dmin)^2 / (12 D^2).
double mean_square_ratio(double size_ratio);

/// Returns the world of a plan without grains, with side walls or a period.
World empty_bed(const BedPlan& plan);

/// Adds the floor: a row of glued grains, or a plane. No free grain can be added afterwards.
void add_floor(const BedPlan& plan, World& world);

// Deposition by collapse: all grains fall simultaneously from a loose random arrangement. The resulting beds
// are loose, and contract during the tilt (docs/preparation.md).

/// Returns the largest solid fraction of the loose arrangement for a size ratio: one grain in each square
/// cell as wide as the largest grain.
double largest_initial_solid_fraction(double size_ratio);

/// Returns a bed of grains at rest above the floor, one at a random position in each cell of a square
/// lattice, with ids that increase from the floor upwards. The solid fraction is `initial_solid_fraction`, or
/// less if the size ratio requires it. The same plan gives the same bed on every platform.
World make_loose_bed(const BedPlan& plan, double initial_solid_fraction = 0.5);

// Geometric deposition: grains are placed one after another, each at its position of rest on the earlier
// ones (Visscher and Bolsterli 1972, Nature 239, 504). Contact Dynamics determines the forces afterwards.

/// Rule by which a grain finds its position.
struct GeometricRule {
  /// Critical angle between contact normal and vertical, rad, in [0, pi/2]: a grain that lands on another one
  /// at a smaller angle stays there (Bratberg, Radjai and Hansen 2002, Phys. Rev. E 66, 031303). With 0 it
  /// always rolls into a local minimum of height, with pi/2 never.
  double critical_angle = 0.0;
  int sites = 1;  ///< number of positions tried, of which the lowest is kept
};

/// Returns a bed at rest, with ids in the order of deposition. Grains fall at random positions along the bed,
/// at least their radius away from walls. No two bodies overlap beyond round-off. The same plan and rule give
/// the same bed on every platform. The bed must be longer than four of its largest grains.
World make_geometric_bed(const BedPlan& plan, const GeometricRule& rule);

// Deposition by pouring: grains arrive one after another on the bed in its state at that time.
//
// A grain falls freely along a vertical line until it first touches a body. Until then it is not a body of
// the problem: it enters the world at its first contact, with the speed of its arrival. This is the dynamic
// counterpart of random deposition from a source line (Bratberg, Radjai and Hansen 2002).

/// A grain that has not arrived yet.
struct Arrival {
  double radius = 0.0;  ///< m
  double x = 0.0;       ///< m, position of the line along which it falls
};

/// Rule of the arrivals.
struct PourRule {
  double speed = 0.0;     ///< m/s, downwards, at the first contact of a grain
  double interval = 0.0;  ///< s between two arrivals; the first grain arrives at time 0
  double density = 0.0;   ///< kg/m^3
};

/// Returns sizes and positions of all grains of a plan in the order of their arrival. Positions are uniform
/// along the bed, at least the radius away from walls. The same plan gives the same arrivals on every
/// platform.
std::vector<Arrival> pour_arrivals(const BedPlan& plan);

/// Returns how many of `count` grains have arrived by a time (s).
Index arrived_by(double time, const PourRule& rule, Index count);

/// Returns the grains with all arrivals that are missing inserted after the free ones. Only sizes and masses
/// of the inserted grains are meaningful, not their positions.
Grains with_remaining_grains(Grains grains, std::span<const Arrival> arrivals, double density);

/// Adds the arrivals that are due at the time of the world, before a step of length h (s). The free grains of
/// the world must be the arrivals before them. Each gets the next id of a free grain; the ids of floor grains
/// and planes increase, in the contacts as well. A grain is placed above the first body in its way by the
/// distance that it falls in h/2, so that it touches at the midpoint of the step.
void add_due_grains(std::span<const Arrival> arrivals, const PourRule& rule, double h, World& world);

// Geometric removal of overlaps, which turns beds of soft grains into beds of rigid ones.

/// Displacements of the grains, m.
struct Displacement {
  double mean = 0.0, largest = 0.0;
};

/// Moves free grains along the normals of their overlaps until no overlap is deeper than `allowed` (m): two
/// grains by half of the overlap each, a grain at the floor or a wall by all of it. Contacts are processed in
/// the order of their keys, so that the result is the same on every platform. Velocities and contact memory
/// do not change. Ends after a fixed number of sweeps, even if a deeper overlap remains.
Displacement push_apart(World& world, double allowed);

}  // namespace talus::dynamics
