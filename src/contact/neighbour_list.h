#pragma once
/// Candidate pairs: bodies that may touch soon.

#include <cstdint>
#include <tuple>
#include <vector>

#include "base/thread_team.h"
#include "core/world.h"

namespace talus::contact {

// Grains sorted into the cells of a grid, to find the neighbours of a grain.

struct GrainCells {
  double x0 = 0.0, y0 = 0.0;          ///< lower left corner of the grid, m
  double cell_x = 1.0, cell_y = 1.0;  ///< width and height of a cell, m
  Index columns = 1, rows = 1;
  bool periodic = false;
  double length = 0.0;  ///< length of the bed, m

  std::vector<Index> start;       ///< grains of cell k: entries start[k] ... start[k + 1] - 1 of those below
  std::vector<Index> grain;       ///< grains in the order of cells, and of their ids within a cell
  std::vector<Index> grain_cell;  ///< cell of each grain
  std::vector<double> x, y, radius;  ///< properties of the grains in the order of cells
};

/// Sorts the grains into cells that are at least `cell` wide and high. Keeps the memory of `cells`.
void sort_into_cells(const Grains& grains, const Boundary& boundary, double cell, GrainCells& cells);

/// Returns a neighbour b with its periodic image at x_b + shift L as one number. The numbers sort like
/// (b, shift).
inline std::int64_t packed(Index b, int shift) { return 4 * static_cast<std::int64_t>(b) + shift + 1; }
inline Index body_of(std::int64_t neighbour) { return static_cast<Index>(neighbour / 4); }
inline std::int8_t shift_of(std::int64_t neighbour) { return static_cast<std::int8_t>(neighbour % 4 - 1); }

/// Returns the largest possible number of neighbours of a grain, three images of each other grain and the
/// planes, plus one place for a rejected candidate.
std::size_t max_neighbours(const Grains& grains, const Boundary& boundary);

/// A search for the neighbours of grain a: grains with ids from `least` on, and planes, up to a gap of
/// `range`. The range is at most the size of a cell minus the largest diameter.
struct NeighbourSearch {
  Index a = 0;
  Index least = 0;
  double range = 0.0;
  std::int64_t* end = nullptr;  ///< position of the next neighbour; there must be room for max_neighbours
};
void search_grains(const GrainCells& cells, const Grains& grains, NeighbourSearch& search);
void search_planes(const Grains& grains, const Boundary& boundary, NeighbourSearch& search);

/// Pairs of a free grain a and another body b > a, which may be a plane (Boundary), sorted by key
/// (a, b, shift).
struct CandidatePairs {
  std::vector<Index> a, b;
  std::vector<std::int8_t> shift;
  std::vector<double> contact_distance;  ///< r_a + r_b, m; r_a if b is a plane

  std::size_t count() const { return a.size(); }
  void resize(std::size_t count);
  void reserve(std::size_t count);
};

/// List of all pairs whose gap may fall below `reach` before a grain has moved by half the skin since its
/// pairs were listed. The pairs found with the list therefore never depend on its age.
struct NeighbourList {
  CandidatePairs pairs;
  double reach = -1.0;       ///< m
  double skin = 0.0;         ///< m
  std::vector<double> x, y;  ///< positions of the grains when their pairs were listed, m; NaN: not listed yet
  Index free_count = 0;      ///< number of free grains in x and y
  std::int64_t rebuilds = 0;  ///< number of times that the entire list was built
  std::int64_t renewals = 0;  ///< number of times that the pairs of a few grains were listed again

  // Memory that is kept, so that neither a rebuild nor a renewal allocates.
  GrainCells cells;
  std::vector<std::vector<std::int64_t>> found;  ///< neighbours of the grains of each member of a team
  std::vector<std::size_t> first_found;  ///< first neighbour of each free grain, and the end of the last
  std::vector<std::size_t> part_end;     ///< end of the output of each member of a team
  std::vector<Index> moved;              ///< grains whose pairs are listed again
  std::vector<std::uint8_t> has_moved;   ///< whether a body is in `moved`
  /// Pairs of the grains in `moved`, by key.
  std::vector<std::tuple<Index, Index, std::int8_t>> renewed;
  CandidatePairs next;
};

/// Updates the list if it may not contain all pairs up to a gap of `reach` at the present positions. If only
/// a few grains have moved or arrived, their pairs are listed again, else the entire list is built. A list
/// belongs to one world: changes of radii, planes or lengths are not detected, and grains that are not free
/// must not move. A team, if given, builds the list together; the result is the same.
void update_neighbour_list(NeighbourList& list, const Grains& grains, const Boundary& boundary, double reach,
                           ThreadTeam* team = nullptr);

}  // namespace talus::contact
