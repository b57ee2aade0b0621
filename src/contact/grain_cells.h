#pragma once
/// Grains sorted into the cells of a grid, to find the neighbours of a grain.

#include <cstdint>
#include <vector>

#include "core/boundary.h"
#include "core/grains.h"

namespace talus::contact {

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

}  // namespace talus::contact
