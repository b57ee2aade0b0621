#pragma once
/// The growing neighbourhood of a grain.

#include <cmath>
#include <limits>
#include <vector>

#include "analysis/cells.h"
#include "analysis/free_grains.h"
#include "core/bed_frame.h"

namespace talus::analysis {

/// A grain and its distance.
struct Neighbour {
  double square = 0.0;  ///< squared distance, m^2
  Index grain = 0;
  bool operator<(const Neighbour& other) const {
    return square < other.square || (square == other.square && grain < other.grain);
  }
};

/// Moves the entries with a squared distance up to `high` (m^2) to the front, sorted, and returns their
/// number. No entry may be below `low` (m^2). Fast if the grains are evenly spread over an area. `scratch` is
/// working memory.
std::size_t sort_nearest(std::vector<Neighbour>& neighbours, double low, double high,
                         std::vector<Neighbour>& scratch);

/// The free grains of a frame, visited in the order of their distance from one of them. Only the nearest
/// periodic image counts.
class Neighbourhoods {
 public:
  explicit Neighbourhoods(const BedFrame& bed)
      : moments_(bed.frame.internal_moment),
        x_(free_grain_values(bed.frame.x, bed.statics)),
        y_(free_grain_values(bed.frame.y, bed.statics)),
        cells_(sort_into_cells(x_, y_, bed.statics.mean_diameter, period_of(bed.statics))) {}

  /// Adds up the internal moments of the grains within `radius` (m) of a grain, itself included, in the order
  /// of their distance, and of their ids at equal distance. Calls visit(distance, sum) after each distance
  /// until it returns false.
  template <typename Visit>
  void around(Index centre, double radius, const Visit& visit) {
    const Index column = column_of(cells_, x_[centre]);
    const Index row = row_of(cells_, y_[centre]);
    neighbours_.clear();
    Tensor2 sum;
    double reached = 0.0;  // all grains up to this distance are in the sum
    // Slightly larger than the square because of rounding; the distance itself is compared below.
    const double farthest = radius * radius * (1.0 + 1e-9);
    for (Index ring = 0; reached <= radius; ++ring) {
      const bool more =
          visit_ring(cells_, column, row, ring, [&](Index grain) { add(centre, grain, farthest); });
      // Grains in none of the rings so far are farther than `known`, which is slightly less than the width of
      // the rings because distances are rounded.
      const double known = more ? ring * cells_.size * (1.0 - 1e-9) : std::numeric_limits<double>::infinity();
      const std::size_t count = sort_nearest(neighbours_, reached * reached, known * known, scratch_);
      for (std::size_t k = 0; k < count; ++k) {
        const double distance = std::sqrt(neighbours_[k].square);
        if (distance > radius) return;
        add_to(sum, moments_[neighbours_[k].grain]);  // (T24)
        const bool last_of_distance = k + 1 == count || neighbours_[k + 1].square > neighbours_[k].square;
        if (last_of_distance && !visit(distance, sum)) return;
      }
      neighbours_.erase(neighbours_.begin(), neighbours_.begin() + static_cast<std::ptrdiff_t>(count));
      reached = known;
    }
  }

 private:
  /// Adds a grain if its squared distance is at most `farthest`.
  void add(Index centre, Index grain, double farthest) {
    double dx = x_[grain] - x_[centre];
    dx += nearest_image(dx, cells_.period) * cells_.period;
    const double dy = y_[grain] - y_[centre];
    const double square = dx * dx + dy * dy;
    if (square <= farthest) neighbours_.push_back({square, grain});
  }

  const std::vector<Tensor2>& moments_;
  std::vector<double> x_, y_;
  Cells cells_;
  std::vector<Neighbour> neighbours_, scratch_;
};

}  // namespace talus::analysis
