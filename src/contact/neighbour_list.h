#pragma once
/// Candidate pairs: bodies that may touch soon.

#include <cstdint>
#include <tuple>
#include <vector>

#include "base/thread_team.h"
#include "contact/grain_cells.h"

namespace talus::contact {

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
