#include "contact/grain_cells.h"

#include <algorithm>
#include <cmath>

namespace talus::contact {
namespace {

/// Limits a cell index to [0, count). A position of NaN gets cell 0, so that the step can detect and report
/// it.
Index clamped(double cell, Index count) {
  return cell > 0.0 ? static_cast<Index>(std::min(cell, static_cast<double>(count - 1))) : 0;
}

Index column_of(const GrainCells& cells, double x) {
  return clamped((x - cells.x0) / cells.cell_x, cells.columns);
}
Index row_of(const GrainCells& cells, double y) { return clamped((y - cells.y0) / cells.cell_y, cells.rows); }

void make_grid(const Grains& grains, const Boundary& boundary, double cell, GrainCells& cells) {
  const auto [x_min, x_max] = std::minmax_element(grains.x.begin(), grains.x.end());
  const auto [y_min, y_max] = std::minmax_element(grains.y.begin(), grains.y.end());
  // Limits the grid to a few cells per grain, however far a grain has flown.
  const double limit = std::max(16.0, 4.0 * grains.count());
  cells.periodic = boundary.periodic;
  cells.length = boundary.length;
  cells.x0 = cells.periodic ? 0.0 : *x_min;
  cells.y0 = *y_min;
  const double width = cells.periodic ? boundary.length : std::max(*x_max - *x_min, cell);
  const double height = std::max(*y_max - *y_min, cell);
  cells.columns = clamped(std::floor(width / cell), static_cast<Index>(limit));
  cells.columns = std::max<Index>(cells.columns, 1);
  cells.rows = clamped(std::floor(height / cell), static_cast<Index>(std::max(1.0, limit / cells.columns)));
  cells.rows = std::max<Index>(cells.rows, 1);
  cells.cell_x = width / cells.columns;
  cells.cell_y = height / cells.rows;
}

/// Adds the grains in adjacent cells of one row, displaced by a periodic shift.
void search_row(const GrainCells& cells, const Grains& grains, Index first_cell, Index last_cell, int shift,
                NeighbourSearch& search) {
  const Index least = search.least;
  const double x = grains.x[search.a];
  const double y = grains.y[search.a];
  const double reach = grains.radius[search.a];
  const double offset = shift * cells.length;
  std::int64_t* end = search.end;
  for (Index k = cells.start[first_cell]; k < cells.start[last_cell + 1]; ++k) {
    const Index b = cells.grain[k];
    const double dx = cells.x[k] + offset - x;
    const double dy = cells.y[k] - y;
    const double limit = reach + cells.radius[k] + search.range;
    // Written always and then kept or overwritten, because a branch would be unpredictable here.
    *end = packed(b, shift);
    end += static_cast<int>(b >= least) & static_cast<int>(dx * dx + dy * dy < limit * limit);
  }
  search.end = end;
}

}  // namespace

// Counting sort.
void sort_into_cells(const Grains& grains, const Boundary& boundary, double cell, GrainCells& cells) {
  make_grid(grains, boundary, cell, cells);
  const auto count = static_cast<std::size_t>(cells.columns) * cells.rows;
  cells.start.resize(count + 1);  // not assigned, which would allocate for each additional row of cells
  std::fill(cells.start.begin(), cells.start.end(), 0);
  for (auto* field : {&cells.grain_cell, &cells.grain}) field->resize(grains.x.size());
  for (auto* field : {&cells.x, &cells.y, &cells.radius}) field->resize(grains.x.size());
  for (Index i = 0; i < grains.count(); ++i) {
    cells.grain_cell[i] = row_of(cells, grains.y[i]) * cells.columns + column_of(cells, grains.x[i]);
    ++cells.start[cells.grain_cell[i] + 1];
  }
  for (std::size_t k = 0; k < count; ++k) cells.start[k + 1] += cells.start[k];
  for (Index i = 0; i < grains.count(); ++i) {
    const Index place = cells.start[cells.grain_cell[i]]++;
    cells.grain[place] = i;
    cells.x[place] = grains.x[i];
    cells.y[place] = grains.y[i];
    cells.radius[place] = grains.radius[i];
  }
  for (std::size_t k = count; k > 0; --k) cells.start[k] = cells.start[k - 1];
  cells.start[0] = 0;
}

std::size_t max_neighbours(const Grains& grains, const Boundary& boundary) {
  return 3 * grains.x.size() + boundary.planes.size() + 1;
}

void search_grains(const GrainCells& cells, const Grains& grains, NeighbourSearch& search) {
  const Index row = cells.grain_cell[search.a] / cells.columns;
  const Index column = cells.grain_cell[search.a] % cells.columns;
  const Index last = cells.columns - 1;
  for (Index r = std::max<Index>(row - 1, 0); r <= std::min<Index>(row + 1, cells.rows - 1); ++r) {
    const Index start = r * cells.columns;
    search_row(cells, grains, start + std::max<Index>(column - 1, 0), start + std::min(column + 1, last), 0,
               search);
    if (!cells.periodic) continue;
    if (column == 0) search_row(cells, grains, start + last, start + last, -1, search);
    if (column == last) search_row(cells, grains, start, start, 1, search);
  }
}

void search_planes(const Grains& grains, const Boundary& boundary, NeighbourSearch& search) {
  const Index a = search.a;
  for (std::size_t k = 0; k < boundary.planes.size(); ++k) {
    const Plane& plane = boundary.planes[k];
    const double distance = plane.normal.x * grains.x[a] + plane.normal.y * grains.y[a] - plane.offset;
    if (distance - grains.radius[a] < search.range)
      *search.end++ = packed(grains.count() + static_cast<Index>(k), 0);
  }
}

}  // namespace talus::contact
