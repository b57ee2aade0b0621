#include "contact/neighbour_list.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <new>

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

namespace {

// Displacements in units of the skin. When a grain has moved by `farthest` since its pairs were listed, the
// pairs of all grains that have moved by `far` are listed again.
constexpr double farthest = 0.5;
constexpr double far = 0.25;

bool is_within(const NeighbourList& list, const Grains& grains, std::size_t i, double distance) {
  const double dx = grains.x[i] - list.x[i];
  const double dy = grains.y[i] - list.y[i];
  // A grain that wrapped around the periodic edge appears to have moved far, and its shifts are outdated too.
  return dx * dx + dy * dy <= distance * distance;
}

bool are_within(const NeighbourList& list, const Grains& grains, double distance) {
  std::int64_t within = 0;  // as wide as a double, so that the comparisons vectorise
  for (std::size_t i = 0; i < grains.x.size(); ++i)
    within += static_cast<std::int64_t>(is_within(list, grains, i, distance));
  return within == static_cast<std::int64_t>(grains.x.size());
}

void set_pair(const Grains& grains, std::size_t place, Index a, Index b, std::int8_t shift,
              CandidatePairs& pairs) {
  pairs.a[place] = a;
  pairs.b[place] = b;
  pairs.shift[place] = shift;
  pairs.contact_distance[place] = grains.radius[a] + (b < grains.count() ? grains.radius[b] : 0.0);
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

/// Writes the neighbours of grains first ... last - 1 one after another, and the beginning of those of each
/// grain, counted from the first of these grains. Returns the end of the last ones.
std::size_t find_neighbours(NeighbourList& list, const Grains& grains, const Boundary& boundary, double range,
                            std::size_t first, std::size_t last, std::vector<std::int64_t>& found) {
  const std::size_t most = max_neighbours(grains, boundary);
  std::size_t end = 0;
  for (std::size_t a = first; a < last; ++a) {
    list.first_found[a] = end;
    if (found.size() < end + most) found.resize(2 * end + most);
    std::int64_t* const begin = found.data() + end;
    const Index grain = a;
    NeighbourSearch search{.a = grain, .least = grain + 1, .range = range, .end = begin};
    search_grains(list.cells, grains, search);
    search_planes(grains, boundary, search);
    sort_neighbours(begin, search.end);
    end += static_cast<std::size_t>(search.end - begin);
  }
  return end;
}

/// Copies the neighbours of grains first ... last - 1 into the list, from position `place` on.
void list_neighbours(NeighbourList& list, const Grains& grains, std::size_t first, std::size_t last,
                     const std::vector<std::int64_t>& found, std::size_t place) {
  const std::int64_t* neighbour = found.data();
  for (std::size_t a = first; a < last; ++a)
    for (; place < list.first_found[a + 1]; ++place, ++neighbour) {
      set_pair(grains, place, static_cast<Index>(a), body_of(*neighbour), shift_of(*neighbour), list.pairs);
    }
}

/// Finds all pairs up to a gap of `range`. Each member of a team finds those of its grains.
void list_pairs(NeighbourList& list, const Grains& grains, const Boundary& boundary, double range,
                ThreadTeam* team) {
  const std::size_t count = grains.free_count;
  const std::size_t parts = team ? static_cast<std::size_t>(team->size()) : 1;
  const auto begin_of = [count, parts](std::size_t part) { return count * part / parts; };
  // Reserves room for the longest list so far, so that nothing is allocated if the size of the team varies.
  const std::size_t room = list.pairs.a.capacity() + max_neighbours(grains, boundary);
  if (list.found.size() < parts) list.found.resize(parts);
  for (auto& found : list.found)
    if (found.size() < room) found.resize(room);
  list.part_end.resize(parts);
  list.first_found.resize(count + 1);
  // An exception that leaves a member of the team would end the program.
  std::atomic<bool> lacks_memory = false;
  distribute(team, parts, [&](std::size_t part, std::size_t) {
    try {
      list.part_end[part] = find_neighbours(list, grains, boundary, range, begin_of(part), begin_of(part + 1),
                                            list.found[part]);
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
  list.pairs.resize(total);
  distribute(team, parts, [&](std::size_t part, std::size_t) {
    const std::size_t first = begin_of(part);
    list_neighbours(list, grains, first, begin_of(part + 1), list.found[part], list.first_found[first]);
  });
}

/// Sorts the grains into cells in which pairs up to a gap of `range` can be found.
void prepare_search(const Grains& grains, const Boundary& boundary, double range, NeighbourList& list) {
  const double largest = *std::max_element(grains.radius.begin(), grains.radius.end());
  sort_into_cells(grains, boundary, 2.0 * largest + range, list.cells);
}

/// Returns the largest number of grains whose pairs are listed again; if more have moved, the entire list is
/// built.
std::size_t max_renewed(const Grains& grains) { return grains.x.size() / 8; }

/// Reserves memory, so that renewals usually allocate nothing.
void make_room_for_renewals(NeighbourList& list, const Grains& grains, const Boundary& boundary) {
  const std::size_t pairs = list.pairs.count();
  list.moved.reserve(max_renewed(grains) + 1);
  list.has_moved.reserve(grains.x.size() + boundary.planes.size());
  list.renewed.reserve(pairs);
  for (CandidatePairs* const each : {&list.pairs, &list.next}) each->reserve(pairs + pairs / 8);
}

void rebuild(NeighbourList& list, const Grains& grains, const Boundary& boundary, double reach,
             ThreadTeam* team) {
  list.x.clear();  // marks the list as empty, in case an allocation fails
  list.pairs.resize(0);
  if (grains.count() == 0) return;
  // Doubling the skin would halve the frequency of updates, and add 5 % of candidates.
  list.skin = 0.2 * *std::max_element(grains.radius.begin(), grains.radius.end());
  list.reach = reach;
  const double range = list.reach + list.skin;
  prepare_search(grains, boundary, range, list);
  list_pairs(list, grains, boundary, range, team);
  make_room_for_renewals(list, grains, boundary);
  list.free_count = grains.free_count;
  list.y = grains.y;
  list.x = grains.x;
  ++list.rebuilds;
}

/// Inserts arrived free grains after the existing ones: the numbers of bodies after them increase, and their
/// former positions are NaN.
void insert_arrivals(NeighbourList& list, const Grains& grains) {
  const Index first = list.free_count, arrived = grains.free_count - first;
  if (arrived == 0) return;
  for (auto* field : {&list.x, &list.y})  // reserves for both first, in case an allocation fails
    if (field->capacity() < grains.x.size()) field->reserve(2 * grains.x.size());
  for (auto* field : {&list.x, &list.y})
    field->insert(field->begin() + first, static_cast<std::size_t>(arrived),
                  std::numeric_limits<double>::quiet_NaN());
  for (Index& b : list.pairs.b)
    if (b >= first) b += arrived;
  list.free_count = grains.free_count;
}

/// Whether the list belongs to these grains, except some that have arrived since, and is wide enough, but not
/// so wide that it contains many useless pairs.
bool fits(const NeighbourList& list, const Grains& grains, double reach) {
  const auto arrived = static_cast<std::ptrdiff_t>(grains.x.size() - list.x.size());
  return !list.x.empty() && arrived >= 0 && arrived == grains.free_count - list.free_count &&
         reach <= list.reach && list.reach + list.skin <= 1.5 * (reach + list.skin);
}

/// Finds the grains whose pairs must be listed again, and those whose pairs soon would be. Returns false if
/// they are too many for this to pay.
bool find_moved(NeighbourList& list, const Grains& grains, const Boundary& boundary) {
  const std::size_t most = max_renewed(grains);
  list.has_moved.assign(grains.x.size() + boundary.planes.size(), 0);
  list.moved.clear();
  for (std::size_t i = 0; i < grains.x.size(); ++i) {
    if (is_within(list, grains, i, far * list.skin)) continue;
    list.has_moved[i] = 1;
    list.moved.push_back(i);
    if (list.moved.size() > most) return false;
  }
  return true;
}

/// Lists the pairs of the grains that have moved, sorted by key. The range allows for the other grain of a
/// pair: it may be `far` from its listed position, and then move by `farthest` in the opposite direction.
void search_moved(NeighbourList& list, const Grains& grains, const Boundary& boundary) {
  const double range = list.reach + (farthest + far + farthest) * list.skin;
  prepare_search(grains, boundary, range, list);
  std::vector<std::int64_t>& found = list.found.front();
  if (const std::size_t most = max_neighbours(grains, boundary); found.size() < most) found.resize(2 * most);
  list.renewed.clear();
  for (const Index grain : list.moved) {
    NeighbourSearch search{.a = grain, .least = 0, .range = range, .end = found.data()};
    search_grains(list.cells, grains, search);
    search_planes(grains, boundary, search);
    for (const std::int64_t* neighbour = found.data(); neighbour != search.end; ++neighbour) {
      const Index other = body_of(*neighbour);
      const std::int8_t shift = shift_of(*neighbour);
      if (other > grain)
        list.renewed.emplace_back(grain, other, shift);
      else if (!list.has_moved[other])  // otherwise the other grain lists this pair, or is the grain itself
        list.renewed.emplace_back(other, grain, static_cast<std::int8_t>(-shift));
    }
  }
  std::ranges::sort(list.renewed);
}

/// Copies pairs first ... last - 1 of one list to the end of another.
void append(const CandidatePairs& from, std::size_t first, std::size_t last, CandidatePairs& to) {
  const auto add = [first, last](const auto& values, auto& more) {
    more.insert(more.end(), values.begin() + static_cast<std::ptrdiff_t>(first),
                values.begin() + static_cast<std::ptrdiff_t>(last));
  };
  add(from.a, to.a);
  add(from.b, to.b);
  add(from.shift, to.shift);
  add(from.contact_distance, to.contact_distance);
}

/// Replaces the pairs of the grains that have moved by those that were found.
void merge_renewed(NeighbourList& list, const Grains& grains) {
  const CandidatePairs& old = list.pairs;
  CandidatePairs& next = list.next;
  next.resize(0);
  const auto is_renewed = [&](std::size_t k) { return list.has_moved[old.a[k]] | list.has_moved[old.b[k]]; };
  std::size_t k = 0;
  const auto keep_until = [&](Index a, Index b) {
    while (k < old.count() && (old.a[k] < a || (old.a[k] == a && old.b[k] < b))) {
      const std::size_t first = k;
      while (k < old.count() && !is_renewed(k) && (old.a[k] < a || (old.a[k] == a && old.b[k] < b))) ++k;
      append(old, first, k, next);
      while (k < old.count() && is_renewed(k)) ++k;
    }
  };
  for (const auto& [a, b, shift] : list.renewed) {
    keep_until(a, b);
    next.resize(next.count() + 1);
    set_pair(grains, next.count() - 1, a, b, shift, next);
  }
  keep_until(grains.count(), 0);
  std::swap(list.pairs, list.next);
}

}  // namespace

void CandidatePairs::resize(std::size_t count) {
  for (auto* field : {&a, &b}) field->resize(count);
  shift.resize(count);
  contact_distance.resize(count);
}

void CandidatePairs::reserve(std::size_t count) {
  for (auto* field : {&a, &b}) field->reserve(count);
  shift.reserve(count);
  contact_distance.reserve(count);
}

void update_neighbour_list(NeighbourList& list, const Grains& grains, const Boundary& boundary, double reach,
                           ThreadTeam* team) {
  if (!fits(list, grains, reach)) return rebuild(list, grains, boundary, reach, team);
  insert_arrivals(list, grains);
  if (are_within(list, grains, farthest * list.skin)) return;
  if (!find_moved(list, grains, boundary)) return rebuild(list, grains, boundary, reach, team);
  search_moved(list, grains, boundary);
  merge_renewed(list, grains);
  for (const Index i : list.moved) {
    list.x[i] = grains.x[i];
    list.y[i] = grains.y[i];
  }
  ++list.renewals;
}

}  // namespace talus::contact
