#include "dynamics/disc_grid.h"

#include <algorithm>

namespace talus::dynamics {

DiscGrid::DiscGrid(const Boundary& boundary, double largest) : boundary_(boundary), height_(largest) {
  columns_ = std::max<Index>(1, static_cast<Index>(std::min(std::floor(boundary.length / largest), 1e8)));
  width_ = boundary.length / columns_;
}

void DiscGrid::add(const PlacedDisc& disc) {
  const Index row = row_of(disc.y), column = std::clamp<Index>(column_of(disc.x), 0, columns_ - 1);
  const auto columns = static_cast<std::size_t>(columns_);
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
    const PlacedDisc& disc = discs_[static_cast<std::size_t>(i)];
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

}  // namespace talus::dynamics
