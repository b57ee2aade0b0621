#pragma once
/// Discs sorted by position, so that a falling or rolling grain is compared only with nearby ones.

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/boundary.h"
#include "core/types.h"

namespace talus::dynamics {

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
  const PlacedDisc& operator[](Index disc) const { return discs_[static_cast<std::size_t>(disc)]; }
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

}  // namespace talus::dynamics
