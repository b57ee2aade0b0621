#pragma once
/// The order in which a sweep visits the contacts, and the contacts that it may visit simultaneously.

#include <array>
#include <vector>

#include "solver/problem.h"
#include "solver/sweep_kernels.h"

namespace talus::solver {

/// Order of a sweep. Contacts are swept from the first body to the last, in the sense that a contact follows
/// all earlier contacts that share a body with it. To sweep eight contacts at a time and with several
/// threads,
///   - bodies are divided into domains with about equal numbers of contacts: of consecutive columns in large
///     beds (ContactProblem), else of consecutive bodies;
///   - a sweep has three phases: even domains with the contacts between them and their odd neighbours; odd
///     domains; the remaining contacts, usually none if domains consist of columns. The parts of a phase
///     share no body that moves, so they can be swept simultaneously;
///   - within a part, contacts form groups of eight, a few of them interleaved. The contacts of such a set of
///     groups share no body that moves; each contact belongs to the first set that has room.
/// The order follows from the problem alone, so that the bits of a result do not depend on the threads.
struct SweepOrder {
  static constexpr int phases = 3;
  static constexpr Index max_domains = 256, max_parts = max_domains + 1;
  std::vector<Index> slot;          ///< slot of each contact: lane_count * group + lane
  std::vector<Index> row_a, row_b;  ///< rows of the bodies of each contact
  /// Runs of rows. The bodies of a domain have consecutive rows, in three runs. In an odd domain these are
  /// the bodies in contact with the even domain before it, with neither neighbour, and with the even domain
  /// after it; in an even domain the middle run contains all bodies. Run k of domain d begins in row
  /// first_row[runs * d + k].
  static constexpr Index runs = 3;
  enum Run : Index { meets_before, meets_none, meets_after };
  std::vector<Index> first_row;
  std::vector<Index> part_begin;                ///< groups of part k: part_begin[k] ... part_begin[k + 1] - 1
  std::array<Index, phases + 1> phase_begin{};  ///< parts of each phase, likewise
  Index row_count = 0;                          ///< number of rows: those of bodies, and fixed ones

  /// Returns the row of the first or second body in a lane of a part if that body does not move. A single row
  /// for all of them would make each group wait for the one before.
  static Index still_row(Index bodies, Index part, Index side, Index lane) {
    return bodies + (2 * part + side) * lane_count + lane;
  }
  Index domain_count() const { return phase_begin[2]; }
  /// Returns the part of domain d; even domains come first.
  Index part_of(Index d) const { return d / 2 + (d % 2 == 0 ? 0 : phase_begin[1]); }
  struct Rows {
    Index first, last;  ///< range first ... last - 1
  };
  Rows rows_of_run(Index d, Run run) const {
    return {first_row[runs * d + run], first_row[runs * d + run + 1]};
  }
  Rows rows_of_domain(Index d) const { return {first_row[runs * d], first_row[runs * (d + 1)]}; }
  /// Whether each domain shares contacts only with its two neighbours, the last domain with the first.
  bool is_ring() const { return by_columns && part_begin[phase_begin[2]] == group_count(); }
  Index part_count() const { return static_cast<Index>(part_begin.size()) - 1; }
  Index group_count() const { return part_begin.back(); }

  bool by_columns = false;  ///< whether domains consist of columns

  // Working memory. A place is a set of interleaved groups, before empty ones are removed.
  std::vector<Index> domain, row, part, owner, first_place, room, contacts_of_column, domain_of_column;
  std::vector<std::array<Index, max_parts>> shares;  ///< number of contacts of each part, by member
  std::vector<std::uint8_t> fill;
  std::array<std::vector<Index>, phases> next_place;
};

// Contacts with swept[c] != 0 are ordered; the others have no slot. All members of a team find parts, order
// them, and place slots; one member begins, opens and ends the order. The members wait for each other after
// each function.

/// Assigns the bodies to domains, for a team of this size. `first_a[i]` is the number of contacts whose first
/// body is before body i. Contacts must be sorted by their first body.
void begin_order(const ContactProblem& problem, const std::vector<Index>& first_a, int size,
                 SweepOrder& order);
/// Finds the part of each contact between bodies of the same domain, among the contacts of this member.
/// moves[i] is 0 for a body that cannot move.
void find_parts(const ContactProblem& problem, const std::vector<std::uint8_t>& moves,
                const std::vector<std::uint8_t>& swept, int member, int size, SweepOrder& order);
/// Finds the parts of the other contacts, assigns rows to the bodies, and reserves for each part the number
/// of places that it can need.
void open_order(const ContactProblem& problem, const std::vector<std::uint8_t>& moves,
                const std::vector<std::uint8_t>& swept, SweepOrder& order);
/// Assigns the contacts of a member's parts, in their order, to the first place with room after all contacts
/// that share a body with them, and computes their slots, counted from the first place of their part.
void order_parts(const ContactProblem& problem, const std::vector<std::uint8_t>& moves,
                 const std::vector<std::uint8_t>& swept, int member, int size, SweepOrder& order);
/// Concatenates the parts, without their empty places.
void end_order(SweepOrder& order);
/// Changes the slots of contacts first ... last - 1 so that they count from the first group of the order.
void place_slots(const std::vector<std::uint8_t>& swept, std::size_t first, std::size_t last,
                 SweepOrder& order);

/// Returns the number of members of a team that have work in each phase of a sweep.
int max_members(const ContactProblem& problem);

}  // namespace talus::solver
