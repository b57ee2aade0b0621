#pragma once
/// Grains sorted into the cells of a grid, to find those near to one of them.

#include <cstdint>
#include <vector>

#include "core/boundary.h"
#include "core/grains.h"

namespace talus::contact {

struct GrainCells {
  double x0 = 0.0, y0 = 0.0;  ///< the lower corner of the grid, m
  double cell_x = 1.0, cell_y = 1.0;
  Index columns = 1, rows = 1;
  bool periodic = false;
  double length = 0.0;  ///< of the bed, m

  std::vector<Index> start;     ///< the grains of cell k are start[k] ... start[k + 1] - 1 of those below
  std::vector<Index> grain;     ///< in the order of cells, in a cell in that of their numbers
  std::vector<Index> of_grain;  ///< the cell of each grain
  std::vector<double> x, y, radius;  ///< in the order of cells
};

/// Sorts the grains into cells that are `cell` wide and high at least. Their memory is kept.
void sort_into_cells(const Grains& grains, const Boundary& boundary, double cell, GrainCells& cells);

/// A grain b seen from another one through a periodic image, which is at x_b + shift L, as one number, b
/// first, so that the numbers sort like (b, shift).
inline std::int64_t packed(Index b, int shift) { return 4 * static_cast<std::int64_t>(b) + shift + 1; }
inline Index body_of(std::int64_t neighbour) { return static_cast<Index>(neighbour / 4); }
inline std::int8_t shift_of(std::int64_t neighbour) { return static_cast<std::int8_t>(neighbour % 4 - 1); }

/// A grain sees each other one through at most three images; one place more holds what is not kept.
std::size_t most_neighbours(const Grains& grains, const Boundary& boundary);

/// The neighbours of grain a: grains numbered `least` or more, and planes, up to a gap of `range`. That is at
/// most the size of a cell less two of the largest radii.
struct NeighbourSearch {
  Index a = 0;
  Index least = 0;
  double range = 0.0;
  std::int64_t* end = nullptr;  ///< where the next neighbour is written; there is room for most_neighbours
};
void search_grains(const GrainCells& cells, const Grains& grains, NeighbourSearch& search);
void search_planes(const Grains& grains, const Boundary& boundary, NeighbourSearch& search);

}  // namespace talus::contact
