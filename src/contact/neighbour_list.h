#pragma once
/// Candidate pairs: which bodies may touch soon.

#include <cstdint>
#include <tuple>
#include <vector>

#include "base/thread_team.h"
#include "contact/grain_cells.h"

namespace talus::contact {

/// Pairs of a free grain a and another body b > a, which may be a plane (Boundary), by key (a, b, shift).
struct CandidatePairs {
  std::vector<Index> a, b;
  std::vector<std::int8_t> shift;
  std::vector<double> contact_distance;  ///< r_a + r_b, m; r_a of a plane

  std::size_t count() const { return a.size(); }
  void resize(std::size_t count);
  void reserve(std::size_t count);
};

/// All pairs whose gap may come below `reach` before a grain has moved by half the skin from where it was
/// when its pairs were listed, so that the pairs found with the list never depend on its age.
struct NeighbourList {
  CandidatePairs pairs;
  double reach = -1.0;        ///< m
  double skin = 0.0;          ///< m
  std::vector<double> x, y;   ///< where each grain was when its pairs were listed, m; NaN: they are not yet
  Index free_count = 0;       ///< of the grains of x and y
  std::int64_t rebuilds = 0;  ///< of the whole list
  std::int64_t renewals = 0;  ///< of the pairs of a few grains

  // Memory that is kept, so that neither a rebuild nor a renewal allocates.
  GrainCells cells;
  std::vector<std::vector<std::int64_t>> found;  ///< by each member of a team: the neighbours of its grains
  std::vector<std::size_t> first_found;          ///< of each free grain, and where those of the last one end
  std::vector<std::size_t> part_end;             ///< where what a member of the team has written ends
  std::vector<Index> moved;                      ///< grains whose pairs are listed anew
  std::vector<std::uint8_t> has_moved;           ///< of each body
  /// Their pairs by key.
  std::vector<std::tuple<Index, Index, std::int8_t>> renewed;
  CandidatePairs next;
};

/// Brings the list up to date, where it does not hold all pairs up to a gap of `reach` at the present
/// positions. The pairs of a few grains that have moved or arrived are listed anew, else the whole list is. A
/// list belongs to one world: it does not notice changed radii, planes or lengths, and grains that are not
/// free never move. The whole list is shared out to the team, if there is one; the result is the same.
void update_neighbour_list(NeighbourList& list, const Grains& grains, const Boundary& boundary, double reach,
                           ThreadTeam* team = nullptr);

}  // namespace talus::contact
