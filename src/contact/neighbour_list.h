#pragma once
/// Candidate pairs: which bodies may touch soon.

#include <cstdint>
#include <vector>

#include "core/boundary.h"
#include "core/grains.h"
#include "core/thread_team.h"

namespace talus {

/// All pairs of a free grain and another body whose gap was below `reach + skin` when the list was made,
/// sorted by key (a, b, shift). Covers every pair with a gap below `reach` until a grain has moved by half
/// the skin, so the pairs found with the list never depend on its age.
struct NeighbourList {
  std::vector<Index> a, b;
  std::vector<std::int8_t> shift;
  std::vector<double> contact_distance;  ///< r_a + r_b, m; r_a of a plane
  double reach = -1.0;                   ///< m
  double skin = 0.0;                     ///< m
  std::vector<double> x, y;              ///< where the grains were, m
  std::int64_t rebuilds = 0;

  // The grains in the order of the cells of a grid, kept so that a rebuild allocates nothing.
  std::vector<Index> cell_start, cell_grain, cell_of_grain;
  std::vector<double> cell_x, cell_y, cell_radius;
  std::vector<std::vector<std::int64_t>> found;  ///< by each member of a team: the neighbours of its grains
  std::vector<std::size_t> first_found;          ///< of each free grain, and where those of the last one end
  std::vector<std::size_t> part_end;             ///< where what a member of the team has written ends
};

/// Rebuilds the list if it does not cover pairs up to a gap of `reach` at the present positions. A list
/// belongs to one world: it does not notice changed radii, planes or lengths. Shared out to the team, if
/// there is one; the result is the same.
void update_neighbour_list(NeighbourList& list, const Grains& grains, const Boundary& boundary, double reach,
                           ThreadTeam* team = nullptr);

}  // namespace talus
