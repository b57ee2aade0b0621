#pragma once
/// The neighbourhood of a grain as it grows.

#include <cmath>
#include <limits>
#include <vector>

#include "analysis/cells.h"
#include "analysis/free_grains.h"
#include "core/bed_frame.h"

namespace talus::analysis {

/// A grain and how far away it is.
struct Near {
  double square = 0.0;  ///< of the distance, m^2
  Index grain = 0;
  bool operator<(const Near& other) const {
    return square < other.square || (square == other.square && grain < other.grain);
  }
};

/// Puts those with a square up to `high` in front, sorted, and returns how many they are; none has less than
/// `low`. Quick where they are evenly spread over an area, as grains are. `scratch` is memory to work in.
std::size_t sort_nearest(std::vector<Near>& near, double low, double high, std::vector<Near>& scratch);

/// The free grains of a frame, ready to be met in the order of their distance from one of them. Of periodic
/// images the nearest counts.
class Neighbourhoods {
 public:
  explicit Neighbourhoods(const BedFrame& bed)
      : moments_(bed.frame.internal_moment),
        x_(of_free_grains(bed.frame.x, bed.statics)),
        y_(of_free_grains(bed.frame.y, bed.statics)),
        cells_(sort_into_cells(x_, y_, bed.statics.mean_diameter, period_of(bed.statics))) {}

  /// Adds the internal moments of the grains within `radius` (m) of a grain, itself among them: the nearest
  /// first, grains at one distance in the order of their ids. After each distance calls meet(distance, sum),
  /// until it returns false.
  template <typename Meet>
  void around(Index centre, double radius, const Meet& meet) {
    const Index column = column_of(cells_, x_[centre]);
    const Index row = row_of(cells_, y_[centre]);
    near_.clear();
    Tensor2 sum;
    double met = 0.0;                                        // all up to this distance were added
    const double farthest = radius * radius * (1.0 + 1e-9);  // a hair more: the distance itself decides
    for (Index ring = 0; met <= radius; ++ring) {
      const bool more =
          visit_ring(cells_, column, row, ring, [&](Index grain) { add(centre, grain, farthest); });
      // What is in no ring yet is farther than `known`, which is a hair less than the rings are wide:
      // distances are rounded.
      const double known = more ? ring * cells_.size * (1.0 - 1e-9) : std::numeric_limits<double>::infinity();
      const std::size_t count = sort_nearest(near_, met * met, known * known, scratch_);
      for (std::size_t k = 0; k < count; ++k) {
        const double distance = std::sqrt(near_[k].square);
        if (distance > radius) return;
        add_to(sum, moments_[near_[k].grain]);  // (T24)
        const bool last_of_distance = k + 1 == count || near_[k + 1].square > near_[k].square;
        if (last_of_distance && !meet(distance, sum)) return;
      }
      near_.erase(near_.begin(), near_.begin() + static_cast<std::ptrdiff_t>(count));
      met = known;
    }
  }

 private:
  /// Where the square of its distance is not above `farthest`.
  void add(Index centre, Index grain, double farthest) {
    double dx = x_[grain] - x_[centre];
    dx += nearest_image(dx, cells_.period) * cells_.period;
    const double dy = y_[grain] - y_[centre];
    const double square = dx * dx + dy * dy;
    if (square <= farthest) near_.push_back({square, grain});
  }

  const std::vector<Tensor2>& moments_;
  std::vector<double> x_, y_;
  Cells cells_;
  std::vector<Near> near_, scratch_;
};

}  // namespace talus::analysis
