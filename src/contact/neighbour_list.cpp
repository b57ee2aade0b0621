#include "contact/neighbour_list.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>

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
  std::int64_t within = 0;  // as wide as a double, so that the comparisons vectorise
  for (std::size_t i = 0; i < grains.x.size(); ++i) {
    const double dx = grains.x[i] - list.x[i];
    const double dy = grains.y[i] - list.y[i];
    // A grain that wrapped around the periodic edge seems to have moved far, and its shifts are stale too.
    within += static_cast<std::int64_t>(dx * dx + dy * dy <= limit);
  }
  return within == static_cast<std::int64_t>(grains.x.size());
}

/// A position that is not a number has a cell too: the step goes on to find it and to report it.
Index clamped(double cell, Index count) {
  return cell > 0.0 ? static_cast<Index>(std::min(cell, static_cast<double>(count - 1))) : 0;
}

Index column_of(const Grid& grid, double x) { return clamped((x - grid.x0) / grid.cell_x, grid.columns); }
Index row_of(const Grid& grid, double y) { return clamped((y - grid.y0) / grid.cell_y, grid.rows); }

Grid make_grid(const Grains& grains, const Boundary& boundary, double cell) {
  const auto [x_min, x_max] = std::minmax_element(grains.x.begin(), grains.x.end());
  const auto [y_min, y_max] = std::minmax_element(grains.y.begin(), grains.y.end());
  // At most a few cells per grain, however far a grain has flown.
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
  list.cell_start.resize(cells + 1);  // not assigned, which would allocate for each additional row of cells
  std::fill(list.cell_start.begin(), list.cell_start.end(), 0);
  for (auto* field : {&list.cell_of_grain, &list.cell_grain}) field->resize(grains.x.size());
  for (auto* field : {&list.cell_x, &list.cell_y, &list.cell_radius}) field->resize(grains.x.size());
  for (Index i = 0; i < grains.count(); ++i) {
    list.cell_of_grain[i] = row_of(grid, grains.y[i]) * grid.columns + column_of(grid, grains.x[i]);
    ++list.cell_start[list.cell_of_grain[i] + 1];
  }
  for (std::size_t cell = 0; cell < cells; ++cell) list.cell_start[cell + 1] += list.cell_start[cell];
  for (Index i = 0; i < grains.count(); ++i) {
    const Index place = list.cell_start[list.cell_of_grain[i]]++;
    list.cell_grain[place] = i;
    list.cell_x[place] = grains.x[i];
    list.cell_y[place] = grains.y[i];
    list.cell_radius[place] = grains.radius[i];
  }
  for (std::size_t cell = cells; cell > 0; --cell) list.cell_start[cell] = list.cell_start[cell - 1];
  list.cell_start[0] = 0;
}

// A neighbour as one number, b first, so that the numbers sort like (b, shift).
std::int64_t packed(Index b, int shift) { return 4 * static_cast<std::int64_t>(b) + shift + 1; }
Index body_of(std::int64_t neighbour) { return static_cast<Index>(neighbour / 4); }
std::int8_t shift_of(std::int64_t neighbour) { return static_cast<std::int8_t>(neighbour % 4 - 1); }

/// The neighbours of one grain as they are found.
struct Search {
  Index a = 0;
  double range = 0.0;
  std::int64_t* end = nullptr;
};

/// Adds the grains b > a of adjacent cells of one row, seen through a periodic shift.
void search_cells(const NeighbourList& list, const Grains& grains, Index first_cell, Index last_cell,
                  int shift, double length, Search& search) {
  const Index a = search.a;
  const double x = grains.x[a];
  const double y = grains.y[a];
  const double reach = grains.radius[a];
  const double offset = shift * length;
  std::int64_t* end = search.end;
  for (Index k = list.cell_start[first_cell]; k < list.cell_start[last_cell + 1]; ++k) {
    const Index b = list.cell_grain[k];
    const double dx = list.cell_x[k] + offset - x;
    const double dy = list.cell_y[k] - y;
    const double limit = reach + list.cell_radius[k] + search.range;
    // Written in any case and then kept or not: a branch would be unpredictable here.
    *end = packed(b, shift);
    end += static_cast<int>(b > a) & static_cast<int>(dx * dx + dy * dy < limit * limit);
  }
  search.end = end;
}

void search_cells_around(const NeighbourList& list, const Grains& grains, const Boundary& boundary,
                         const Grid& grid, Search& search) {
  const Index row = list.cell_of_grain[search.a] / grid.columns;
  const Index column = list.cell_of_grain[search.a] % grid.columns;
  const Index last = grid.columns - 1;
  for (Index r = std::max<Index>(row - 1, 0); r <= std::min<Index>(row + 1, grid.rows - 1); ++r) {
    const Index start = r * grid.columns;
    search_cells(list, grains, start + std::max<Index>(column - 1, 0), start + std::min(column + 1, last), 0,
                 boundary.length, search);
    if (!grid.periodic) continue;
    if (column == 0) search_cells(list, grains, start + last, start + last, -1, boundary.length, search);
    if (column == last) search_cells(list, grains, start, start, 1, boundary.length, search);
  }
}

void search_planes(const Grains& grains, const Boundary& boundary, Search& search) {
  const Index a = search.a;
  for (std::size_t k = 0; k < boundary.planes.size(); ++k) {
    const Plane& plane = boundary.planes[k];
    const double distance = plane.normal.x * grains.x[a] + plane.normal.y * grains.y[a] - plane.offset;
    if (distance - grains.radius[a] < search.range)
      *search.end++ = packed(grains.count() + static_cast<Index>(k), 0);
  }
}

/// Sorts the neighbours of one grain. They are few, so insertion sort is fastest.
void sort_neighbours(std::int64_t* first, std::int64_t* end) {
  for (std::int64_t* next = first; next != end; ++next) {
    const std::int64_t neighbour = *next;
    std::int64_t* hole = next;
    for (; hole != first && hole[-1] > neighbour; --hole) *hole = hole[-1];
    *hole = neighbour;
  }
}

/// A grain sees each other one through at most three images; one place more holds what is not kept.
std::size_t most_neighbours(const Grains& grains, const Boundary& boundary) {
  return 3 * grains.x.size() + boundary.planes.size() + 1;
}

/// Writes the neighbours of grains first ... last - 1 one after another, and tells where those of each grain
/// begin, counted from the first of these grains. Returns where the last ones end.
std::size_t search_grains(NeighbourList& list, const Grains& grains, const Boundary& boundary,
                          const Grid& grid, double range, std::size_t first, std::size_t last,
                          std::vector<std::int64_t>& found) {
  const std::size_t most = most_neighbours(grains, boundary);
  std::size_t end = 0;
  for (std::size_t a = first; a < last; ++a) {
    list.first_found[a] = end;
    if (found.size() < end + most) found.resize(2 * end + most);
    std::int64_t* const begin = found.data() + end;
    Search search{.a = static_cast<Index>(a), .range = range, .end = begin};
    search_cells_around(list, grains, boundary, grid, search);
    search_planes(grains, boundary, search);
    sort_neighbours(begin, search.end);
    end += static_cast<std::size_t>(search.end - begin);
  }
  return end;
}

/// Puts the neighbours of grains first ... last - 1 into the list. `place` is that of the first one.
void list_neighbours(NeighbourList& list, const Grains& grains, std::size_t first, std::size_t last,
                     const std::vector<std::int64_t>& found, std::size_t place) {
  const std::int64_t* neighbour = found.data();
  for (std::size_t a = first; a < last; ++a)
    for (; place < list.first_found[a + 1]; ++place, ++neighbour) {
      const Index b = body_of(*neighbour);
      list.a[place] = static_cast<Index>(a);
      list.b[place] = b;
      list.shift[place] = shift_of(*neighbour);
      list.contact_distance[place] = grains.radius[a] + (b < grains.count() ? grains.radius[b] : 0.0);
    }
}

/// Finds all pairs up to a gap of `range`, each member of a team those of its grains.
void list_pairs(NeighbourList& list, const Grains& grains, const Boundary& boundary, const Grid& grid,
                double range, ThreadTeam* team) {
  const auto count = static_cast<std::size_t>(grains.free_count);
  const std::size_t parts = team ? static_cast<std::size_t>(team->size()) : 1;
  const auto begin_of = [count, parts](std::size_t part) { return count * part / parts; };
  // Room for all that was ever listed, so that nothing is allocated where a team comes and goes.
  const std::size_t room = list.a.capacity() + most_neighbours(grains, boundary);
  if (list.found.size() < parts) list.found.resize(parts);
  for (auto& found : list.found)
    if (found.size() < room) found.resize(room);
  list.part_end.resize(parts);
  list.first_found.resize(count + 1);
  // An exception that leaves a member of the team would end the program.
  std::atomic<bool> lacks_memory = false;
  share_out(team, parts, [&](std::size_t part, std::size_t) {
    try {
      list.part_end[part] = search_grains(list, grains, boundary, grid, range, begin_of(part),
                                          begin_of(part + 1), list.found[part]);
    } catch (const std::bad_alloc&) {
      lacks_memory = true;
    }
  });
  if (lacks_memory) throw std::bad_alloc();
  std::size_t total = 0;
  for (std::size_t part = 0; part < parts; ++part) {
    for (std::size_t a = begin_of(part); a < begin_of(part + 1); ++a) list.first_found[a] += total;
    total += list.part_end[part];
  }
  list.first_found[count] = total;
  for (auto* field : {&list.a, &list.b}) field->resize(total);
  list.shift.resize(total);
  list.contact_distance.resize(total);
  share_out(team, parts, [&](std::size_t part, std::size_t) {
    const std::size_t first = begin_of(part);
    list_neighbours(list, grains, first, begin_of(part + 1), list.found[part], list.first_found[first]);
  });
}

}  // namespace

void update_neighbour_list(NeighbourList& list, const Grains& grains, const Boundary& boundary, double reach,
                           ThreadTeam* team) {
  if (covers(list, grains, reach)) return;
  list.x.clear();  // covers nothing, should memory be missing
  list.a.clear();
  if (grains.count() == 0) return;
  const double largest = *std::max_element(grains.radius.begin(), grains.radius.end());
  // Doubling the skin halves the rebuilds and adds 5 % of candidates: here both cost the same.
  list.skin = 0.2 * largest;
  // While the bed moves fast the reach changes from step to step; some room above it saves rebuilds.
  list.reach = 1.25 * reach;
  const double range = list.reach + list.skin;
  const Grid grid = make_grid(grains, boundary, 2.0 * largest + range);
  fill_cells(list, grains, grid);
  list_pairs(list, grains, boundary, grid, range, team);
  list.y = grains.y;
  list.x = grains.x;
  ++list.rebuilds;
}

}  // namespace talus
