#include "contact/neighbour_list.h"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

struct Grid {
  double x0 = 0.0, y0 = 0.0;
  double cell_x = 1.0, cell_y = 1.0;
  Index columns = 1, rows = 1;
  bool periodic = false;
};

bool covers(const NeighbourList& list, const Grains& grains, double reach) {
  if (list.reach < reach || list.x.size() != grains.x.size()) return false;
  const double limit = 0.25 * list.skin * list.skin;
  for (std::size_t i = 0; i < grains.x.size(); ++i) {
    const double dx = grains.x[i] - list.x[i];
    const double dy = grains.y[i] - list.y[i];
    // A grain that wrapped around the periodic edge seems to have moved far: its shifts are stale too.
    if (!(dx * dx + dy * dy <= limit)) return false;
  }
  return true;
}

Index clamped(double cell, Index count) {
  return static_cast<Index>(std::clamp(cell, 0.0, static_cast<double>(count - 1)));
}

Index column_of(const Grid& grid, double x) { return clamped((x - grid.x0) / grid.cell_x, grid.columns); }
Index row_of(const Grid& grid, double y) { return clamped((y - grid.y0) / grid.cell_y, grid.rows); }

Grid make_grid(const Grains& grains, const Boundary& boundary, double cell) {
  const auto [x_min, x_max] = std::minmax_element(grains.x.begin(), grains.x.end());
  const auto [y_min, y_max] = std::minmax_element(grains.y.begin(), grains.y.end());
  // Never more cells than a few a grain, however far a grain has flown.
  const double limit = std::max(16.0, 4.0 * grains.count());
  Grid grid;
  grid.periodic = boundary.periodic;
  grid.x0 = grid.periodic ? 0.0 : *x_min;
  grid.y0 = *y_min;
  const double width = grid.periodic ? boundary.length : std::max(*x_max - *x_min, cell);
  const double height = std::max(*y_max - *y_min, cell);
  grid.columns = clamped(std::floor(width / cell), static_cast<Index>(limit));
  grid.columns = std::max<Index>(grid.columns, 1);
  grid.rows = clamped(std::floor(height / cell), static_cast<Index>(std::max(1.0, limit / grid.columns)));
  grid.rows = std::max<Index>(grid.rows, 1);
  grid.cell_x = width / grid.columns;
  grid.cell_y = height / grid.rows;
  return grid;
}

/// Counting sort of the grains into cells; within a cell they stay in the order of their ids.
void fill_cells(NeighbourList& list, const Grains& grains, const Grid& grid) {
  const auto cells = static_cast<std::size_t>(grid.columns) * grid.rows;
  list.cell_start.assign(cells + 1, 0);
  list.cell_of_grain.resize(grains.x.size());
  list.cell_grain.resize(grains.x.size());
  for (Index i = 0; i < grains.count(); ++i) {
    list.cell_of_grain[i] = row_of(grid, grains.y[i]) * grid.columns + column_of(grid, grains.x[i]);
    ++list.cell_start[list.cell_of_grain[i] + 1];
  }
  for (std::size_t cell = 0; cell < cells; ++cell) list.cell_start[cell + 1] += list.cell_start[cell];
  for (Index i = 0; i < grains.count(); ++i) list.cell_grain[list.cell_start[list.cell_of_grain[i]]++] = i;
  for (std::size_t cell = cells; cell > 0; --cell) list.cell_start[cell] = list.cell_start[cell - 1];
  list.cell_start[0] = 0;
}

void append(NeighbourList& list, Index a, Index b, std::int8_t shift) {
  list.a.push_back(a);
  list.b.push_back(b);
  list.shift.push_back(shift);
}

/// Sorts the pairs of one grain, from `first` on, by (b, shift): a handful, so insertion sort.
void sort_pairs(NeighbourList& list, std::size_t first) {
  for (std::size_t k = first + 1; k < list.b.size(); ++k) {
    const Index b = list.b[k];
    const std::int8_t shift = list.shift[k];
    std::size_t hole = k;
    for (; hole > first && (list.b[hole - 1] > b || (list.b[hole - 1] == b && list.shift[hole - 1] > shift));
         --hole) {
      list.b[hole] = list.b[hole - 1];
      list.shift[hole] = list.shift[hole - 1];
    }
    list.b[hole] = b;
    list.shift[hole] = shift;
  }
}

/// Pairs of grain a with the grains b > a of one cell, seen through a periodic shift.
void pair_with_cell(NeighbourList& list, const Grains& grains, Index a, Index cell, std::int8_t shift,
                    double offset, double range) {
  for (Index k = list.cell_start[cell]; k < list.cell_start[cell + 1]; ++k) {
    const Index b = list.cell_grain[k];
    if (b <= a) continue;
    const double dx = grains.x[b] + offset - grains.x[a];
    const double dy = grains.y[b] - grains.y[a];
    const double limit = grains.radius[a] + grains.radius[b] + range;
    if (dx * dx + dy * dy < limit * limit) append(list, a, b, shift);
  }
}

void pair_with_grains(NeighbourList& list, const Grains& grains, const Boundary& boundary, const Grid& grid,
                      Index a, double range) {
  const Index row = list.cell_of_grain[a] / grid.columns;
  const Index column = list.cell_of_grain[a] % grid.columns;
  for (Index r = std::max<Index>(row - 1, 0); r <= std::min<Index>(row + 1, grid.rows - 1); ++r) {
    for (Index c = column - 1; c <= column + 1; ++c) {
      int shift = 0;
      Index wrapped = c;
      if (c < 0 || c >= grid.columns) {
        if (!grid.periodic) continue;
        shift = c < 0 ? -1 : 1;
        wrapped = c - shift * grid.columns;
      }
      pair_with_cell(list, grains, a, r * grid.columns + wrapped, static_cast<std::int8_t>(shift),
                     shift * boundary.length, range);
    }
  }
}

void pair_with_planes(NeighbourList& list, const Grains& grains, const Boundary& boundary, Index a,
                      double range) {
  for (std::size_t k = 0; k < boundary.planes.size(); ++k) {
    const Plane& plane = boundary.planes[k];
    const double distance = plane.normal.x * grains.x[a] + plane.normal.y * grains.y[a] - plane.offset;
    if (distance - grains.radius[a] < range) append(list, a, grains.count() + static_cast<Index>(k), 0);
  }
}

}  // namespace

void update_neighbour_list(NeighbourList& list, const Grains& grains, const Boundary& boundary,
                           double reach) {
  if (covers(list, grains, reach)) return;
  list.a.clear();
  list.b.clear();
  list.shift.clear();
  list.x = grains.x;
  list.y = grains.y;
  if (grains.count() == 0) return;
  const double largest = *std::max_element(grains.radius.begin(), grains.radius.end());
  list.skin = 0.1 * largest;
  // While the bed moves fast the reach changes from step to step: some room above it saves rebuilds.
  list.reach = 1.25 * reach;
  const double range = list.reach + list.skin;
  const Grid grid = make_grid(grains, boundary, 2.0 * largest + range);
  fill_cells(list, grains, grid);
  for (Index a = 0; a < grains.free_count; ++a) {
    const std::size_t first = list.a.size();
    pair_with_grains(list, grains, boundary, grid, a, range);
    pair_with_planes(list, grains, boundary, a, range);
    sort_pairs(list, first);
  }
  ++list.rebuilds;
}

}  // namespace talus
