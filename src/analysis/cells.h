#pragma once
/// Points sorted into the cells of a grid, for neighbour searches.

#include <vector>

#include "core/types.h"

namespace talus::analysis {

/// Points sorted into the cells of a grid. In a periodic bed, x is taken modulo the period.
struct Cells {
  double size = 1.0;    ///< height of the cells along y, m
  double width = 1.0;   ///< along x, m, at least `size`; a whole number of cells makes up a period
  double period = 0.0;  ///< m; 0 if the bed is not periodic
  double x_min = 0.0, y_min = 0.0;  ///< lower left corner of the first cell, m
  Index columns = 1, rows = 1;      ///< cell k = row * columns + column
  /// Position in `point` of the first point of each cell; the last entry is the end.
  std::vector<Index> start = {0, 0};
  std::vector<Index> point;  ///< ids of the points, cell by cell, ascending within a cell
};

/// Sorts the points (x, y), m, into cells of at least `size` m. The cells are enlarged if there would be more
/// than a few for each point. `period` is 0 if the bed is not periodic.
Cells sort_into_cells(const std::vector<double>& x, const std::vector<double>& y, double size, double period);

/// Return the column and the row of the cell that contains x and y (m). A point outside the grid belongs to
/// the nearest cell; x is taken modulo the period.
Index column_of(const Cells& cells, double x);
Index row_of(const Cells& cells, double y);

/// Returns the number of periods to add to a distance dx along x, at most one period long, to obtain its
/// shortest periodic image; 0 for period 0.
inline Index nearest_image(double dx, double period) {
  if (dx > 0.5 * period) return period > 0.0 ? -1 : 0;
  return dx < -0.5 * period && period > 0.0 ? 1 : 0;
}

/// Calls visit(id) for the points in the square ring of cells that are `ring` cells away from (column, row);
/// ring 0 is the cell itself. Points in none of the rings up to this one are farther than ring * size from
/// every point of (column, row). In a periodic bed each cell is visited once, in the smallest ring that
/// contains it. Returns false if the whole ring lies outside the grid.
template <typename Visit>
bool visit_ring(const Cells& cells, Index column, Index row, Index ring, const Visit& visit) {
  // Largest difference in columns to either side: half the circumference if the bed is periodic.
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
