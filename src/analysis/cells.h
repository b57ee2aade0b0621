#pragma once
/// Points sorted into cells, to find those near a place.

#include <vector>

#include "core/types.h"

namespace talus::analysis {

/// Points in the cells of a grid. In a periodic bed x is taken modulo the period.
struct Cells {
  double size = 1.0;                  ///< m, along y
  double width = 1.0;                 ///< m, along x, `size` or more: whole cells make up a period
  double period = 0.0;                ///< m; 0 where the bed is not periodic
  double x_min = 0.0, y_min = 0.0;    ///< m, the corner of the first cell
  Index columns = 1, rows = 1;        ///< cell k = row * columns + column
  std::vector<Index> start = {0, 0};  ///< of each cell in `point`; one more than there are cells
  std::vector<Index> point;           ///< ids, ascending within a cell
};

/// Points (x, y), m, in cells of at least `size` m, but no finer than a few for each point. `period` 0: not
/// periodic.
Cells sort_into_cells(const std::vector<double>& x, const std::vector<double>& y, double size, double period);

Index column_of(const Cells& cells, double x);
Index row_of(const Cells& cells, double y);

/// How many periods bring a distance dx along x, at most a period long, to the shortest of its images; 0 for
/// period 0.
inline Index nearest_image(double dx, double period) {
  if (dx > 0.5 * period) return period > 0.0 ? -1 : 0;
  return dx < -0.5 * period && period > 0.0 ? 1 : 0;
}

/// Calls visit(id) for the points of the cells that are `ring` cells away from (column, row), the ring being
/// a square; ring 0 is the cell itself. Points that are in no ring up to this one are farther than
/// ring * size from all points of (column, row). Each cell of a periodic bed is met once, in the smallest
/// ring that has it. Returns false where the whole ring lies outside the grid.
template <typename Visit>
bool visit_ring(const Cells& cells, Index column, Index row, Index ring, const Visit& visit) {
  // How far columns differ at most: half a turn, where the bed is periodic.
  const bool periodic = cells.period > 0.0;
  const Index left = periodic ? (cells.columns - 1) / 2 : column;
  const Index right = periodic ? cells.columns / 2 : cells.columns - 1 - column;
  const auto cell = [&](Index across, Index up) {
    if (across < -left || across > right || row + up < 0 || row + up >= cells.rows) return;
    Index at = column + across;
    if (at < 0) at += cells.columns;
    if (at >= cells.columns) at -= cells.columns;
    const Index k = (row + up) * cells.columns + at;
    for (Index p = cells.start[k]; p < cells.start[k + 1]; ++p) visit(cells.point[p]);
  };
  if (ring == 0) {
    cell(0, 0);
    return true;
  }
  for (Index across = -ring; across <= ring; ++across) {
    cell(across, -ring);
    cell(across, ring);
  }
  for (Index up = -ring + 1; up < ring; ++up) {
    cell(-ring, up);
    cell(ring, up);
  }
  return ring <= left || ring <= right || ring <= row || ring <= cells.rows - 1 - row;
}

}  // namespace talus::analysis
