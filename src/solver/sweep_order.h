#pragma once
/// In which order a sweep visits the contacts, and which of them it may visit at the same time.

#include <array>
#include <vector>

#include "solver/problem.h"
#include "solver/sweep_kernels.h"

namespace talus::solver {

/// Contacts are swept in their order, from the first body to the last, as far as that matters: a contact
/// comes after all earlier ones that share a body with it. So that this can be done eight contacts at a time
/// and by several threads,
///   - bodies are cut into domains with about as many contacts each: of consecutive columns in large beds
///     (ContactProblem), else of consecutive bodies;
///   - a sweep has three phases: even domains with the contacts between them and their odd neighbours; odd
///     domains; what is left, which as a rule is nothing where domains are of columns. The parts of a phase
///     share no body that moves, so they can be swept at once;
///   - within a part, contacts go in groups of eight, a few groups side by side, that share no body that
///     moves; each contact goes in the first group that has room.
/// All of this follows from the problem alone, so that the bits of a result do not depend on threads.
struct SweepOrder {
  static constexpr int phases = 3;
  static constexpr Index most_domains = 256, most_parts = most_domains + 1;
  std::vector<Index> slot;          ///< of a contact: lane_count * group + lane
  std::vector<Index> row_a, row_b;  ///< rows of its bodies
  /// The bodies of a domain have rows next to each other, in three runs: of an odd domain those that meet the
  /// even domain before it in its phase, those that meet neither of the two next to it, and those that meet
  /// the one after it; of an even domain the run in the middle has all. Run k of domain d begins in row
  /// first_row[runs * d + k].
  static constexpr Index runs = 3;
  enum Run : Index { meets_before, meets_none, meets_after };
  std::vector<Index> first_row;
  std::vector<Index> part_begin;  ///< the groups of part k: part_begin[k] ... part_begin[k + 1] - 1
  std::array<Index, phases + 1> phase_begin{};  ///< the parts of a phase
  Index row_count = 0;                          ///< bodies, and rows that do not move

  /// The row of the first or second body in a lane of a part, where that does not move: one row for all would
  /// make each group wait for the one before.
  static Index still_row(Index bodies, Index part, Index side, Index lane) {
    return bodies + (2 * part + side) * lane_count + lane;
  }
  Index domain_count() const { return phase_begin[2]; }
  /// Even domains come first.
  Index part_of(Index d) const { return d / 2 + (d % 2 == 0 ? 0 : phase_begin[1]); }
  struct Rows {
    Index first, last;  ///< first ... last - 1
  };
  Rows rows_of_run(Index d, Run run) const {
    return {first_row[runs * d + run], first_row[runs * d + run + 1]};
  }
  Rows rows_of_domain(Index d) const { return {first_row[runs * d], first_row[runs * (d + 1)]}; }
  /// Whether each domain shares contacts with the ones next to it only, the last one with the first.
  bool is_ring() const { return by_columns && part_begin[phase_begin[2]] == group_count(); }
  Index part_count() const { return static_cast<Index>(part_begin.size()) - 1; }
  Index group_count() const { return part_begin.back(); }

  bool by_columns = false;  ///< domains are of columns

  // Memory to work in: places are groups side by side before those that stay empty are left out.
  std::vector<Index> domain, row, part, owner, first_place, room, contacts_of_column, domain_of_column;
  std::vector<std::array<Index, most_parts>> shares;  ///< contacts of each part that a member has found
  std::vector<std::uint8_t> fill;
  std::array<std::vector<Index>, phases> next_place;
};

// Contacts with swept[c] != 0 are ordered; the others have no slot. All members of a team find parts, order
// them, and place slots; one begins, opens, and ends. After each of these the others wait.

/// Shares the bodies out to domains, for a team of this size. `first_a[i]` is the number of contacts whose
/// first body is before body i. Contacts must be sorted by their first body.
void begin_order(const ContactProblem& problem, const std::vector<Index>& first_a, int size,
                 SweepOrder& order);
/// Finds the part of each contact between bodies of the same domain, of those that are the member's. moves[i]
/// is 0 for a body that nothing moves.
void find_parts(const ContactProblem& problem, const std::vector<std::uint8_t>& moves,
                const std::vector<std::uint8_t>& swept, int member, int size, SweepOrder& order);
/// Finds the parts of the other contacts, gives the bodies their rows, and each part as many places as it can
/// need.
void open_order(const ContactProblem& problem, const std::vector<std::uint8_t>& moves,
                const std::vector<std::uint8_t>& swept, SweepOrder& order);
/// Puts the contacts of a member's parts, in their order, into the first place with room after all that share
/// a body with them, and gives them slots, counted from the first place of their part.
void order_parts(const ContactProblem& problem, const std::vector<std::uint8_t>& moves,
                 const std::vector<std::uint8_t>& swept, int member, int size, SweepOrder& order);
/// Puts the parts one after another.
void end_order(SweepOrder& order);
/// Counts the slots of contacts first ... last - 1 from the first group of all.
void place_slots(const std::vector<std::uint8_t>& swept, std::size_t first, std::size_t last,
                 SweepOrder& order);

/// How many members of a team find work in each phase of a sweep.
int most_members(const ContactProblem& problem);

}  // namespace talus::solver
