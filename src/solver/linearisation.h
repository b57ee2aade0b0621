#pragma once
/// The two precisions of the accelerated solver. The impulses P0, the velocities and the residual are in
/// double precision. The sweeps search for an increment p = P - P0 in single precision, with half the bytes
/// and twice the lanes. P0 is replaced by P0 + p from time to time, so that any tolerance can be reached
/// (mixed-precision iterative refinement, Wilkinson 1963).

#include <array>
#include <cstdint>
#include <vector>

#include "base/thread_team.h"
#include "solver/problem.h"
#include "solver/sweep_kernels.h"

namespace talus::solver {

// The order in which a sweep visits the contacts, and the contacts that it may visit simultaneously.

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

// Data of the accelerated solver for contacts that resist rolling, in addition to the Linearisation of their
// forces: the rolling impulse P_r in both precisions.

struct RollingContacts {
  // Double precision, at P0, in the order of the problem: rolling impulse (N s), its relative velocity (m/s),
  // 1 / W_rr (kg), and l (m).
  std::vector<double> pr, ur, wr, length;
  // Single precision, in the order of the sweep.
  std::vector<RollingGroup> groups;
  std::vector<RollingImpulses> increment, last_move;
  double unit_length = 1.0;  ///< m; the turn of a row is omega times this length

  bool any() const { return !pr.empty(); }
};

/// The unit of length, and the units of a Linearisation (impulse and velocity as inverses).
struct RollingUnits {
  double length, per_impulse, per_velocity, mobility;
};

/// Sizes the arrays of the contacts, and chooses the unit of length.
void size_rolling(const ContactProblem& problem, RollingContacts& w);

/// Computes the data of contact c that depend on contacts and bodies only.
void load_rolling(const ContactProblem& problem, std::size_t c, RollingContacts& w);

/// Loads the data of contact c that depend on contacts and bodies only into its group: mobilities and
/// lengths.
void load_rolling_group(const ContactProblem& problem, std::size_t c, Index slot, const RollingUnits& units,
                        RollingContacts& w);
/// Sets the increment and the last move of a slot to zero.
void start_rolling(Index slot, RollingContacts& w);
/// Loads the relative velocity of contact c at P0, and the increments at which it begins to roll.
void linearise_rolling(const ContactProblem& problem, std::size_t c, Index slot, double pn,
                       const RollingUnits& units, RollingContacts& w);
/// Returns P0_r + p_r and sets the increment to zero.
double take_rolling_increment(std::size_t c, Index slot, double impulse_unit, RollingContacts& w);

/// Adds the fields of these contacts to those from which the residual is computed.
void take_rolling(const ContactProblem& problem, RollingContacts& w, ResidualArrays& arrays);

/// Number of contacts in a block. Blocks are distributed to the members of a team; their sums do not depend
/// on the member that computes them.
inline constexpr Index contacts_per_block = 512;

struct BlockSums {
  ResidualSums residual;
  Index pressed = 0;  ///< number of contacts that are not swept and whose bodies approach each other
};

/// Arrays kept between solves.
struct Linearisation {
  // Double precision, at P0, in the order of the problem: impulses (N s), relative velocities (m/s), and
  // inverses of the Delassus diagonal (kg).
  std::vector<double> pn, pt, un, ut, wn, wt;
  std::vector<ExactRow> exact_force;  ///< impulses of the contacts, and one more entry of zero
  std::vector<ExactRow> exact_velocity;
  std::vector<BlockSums> sums;
  /// Contacts of the bodies. Body i is the first body of contacts first_a[i] ... first_a[i + 1] - 1. All its
  /// contacts c are listed in entries first_side[i] ... first_side[i + 1] - 1 of `sides`: first as 2 c if it
  /// is the second body, then, from first_own_side[i] on, as 2 c + 1 if it is the first. The list is padded
  /// to a multiple of sides_at_once with the contact after the last.
  std::vector<Index> first_a, first_side, first_own_side, next_side;
  std::vector<std::uint32_t> sides;
  std::vector<std::uint8_t> moves;  ///< whether the body can move
  std::vector<std::uint8_t> swept;  ///< whether the contact takes part in the sweeps

  // Single precision, in the order of the sweep.
  SweepOrder order;
  std::vector<ContactGroup> contacts;
  std::vector<UnlikeGroup> unlike;  ///< empty if contacts are alike
  std::vector<ImpulseGroup> increment, last_move;
  std::vector<Row> velocity, before;

  RollingContacts rolling;  ///< empty if no contact resists rolling

  // Data computed for the contacts and bodies of the last problem remain valid if these are the same, as in
  // most steps of a quiet bed.
  ContactProblem linked;                    ///< last problem, without velocities, normals and c
  std::vector<std::uint8_t> ordered_swept;  ///< `swept` for which the order was made; empty: no order
  bool are_new = true;      ///< whether contacts or bodies differ from those of the last problem
  bool are_loaded = false;  ///< whether the data of contacts and bodies are complete; false after a failure
  bool have_new_order = true;  ///< whether all groups must be loaded again
  /// Units of the single precision: impulse (N s), the velocity (m/s) that it gives a mean body, and their
  /// ratio, the mean inverse mass of the bodies that move (1/kg).
  double impulse_unit = 1.0, velocity_unit = 1.0, mobility_unit = 1.0;
  Index moving = 0;  ///< number of bodies with a finite mass
  /// Whether all contacts have the same friction, and all bodies are disks in single precision: r^2 / I is
  /// 2 / m, or both vanish.
  bool are_alike = false;
};

/// Sizes the arrays, links bodies to their contacts, and chooses the units. `team` may be null.
void prepare(const ContactProblem& problem, const ContactSolution& guess, ThreadTeam* team, Linearisation& w);

// The following functions are distributed to the members of a team, except the beginning and the end of an
// order: each member processes some blocks of contacts or some bodies, and waits for the others before the
// next function.

/// Sets P0 to these impulses, made admissible.
void load_contacts(const ContactProblem& problem, const ContactSolution& impulses, Index first_block,
                   Index last_block, Linearisation& w);
/// Computes the velocities at P0 of bodies first ... last - 1.
void sum_exact_velocities(const ContactProblem& problem, const SweepKernels& kernels, Index first, Index last,
                          Linearisation& w);
/// Computes the relative velocities at P0 and the sums of the blocks.
void linearise_contacts(const ContactProblem& problem, const SweepKernels& kernels, Index first_block,
                        Index last_block, Linearisation& w);

/// The natural-map residual at P0, as defined by natural_map_residual.
struct ExactResidual {
  Residual residual;
  double norm = 0.0;  ///< || P0 ||, or || P' || if P0 vanishes, in impulse units
  bool cold = true;   ///< whether P0 vanishes
  Index pressed = 0;  ///< see BlockSums
};
ExactResidual exact_residual(const Linearisation& w);

/// Chooses the contacts to sweep at first: those with an impulse, and those that may close while the
/// velocities change. Any other contact that would close is counted as pressed.
void choose_swept(const ContactProblem& problem, Index first_block, Index last_block, Linearisation& w);
/// Adds the pressed contacts to those that are swept.
void add_pressed(const ContactProblem& problem, Index first_block, Index last_block, Linearisation& w);
/// Begins a new order of the contacts to be swept, unless the last one still applies; then only groups need
/// to be loaded (have_new_order is false). One member begins and ends an order for all.
void begin_order_of_contacts(const ContactProblem& problem, int size, Linearisation& w);
void end_order_of_contacts(const ContactProblem& problem, Linearisation& w);
/// Loads the swept contacts, linearised at P0, with zero increments.
void load_groups(const ContactProblem& problem, Index first_block, Index last_block, Linearisation& w);
void clear_rows(Index first, Index last, Linearisation& w);

// P0 is replaced by P0 + p in five parts: increments and velocities are absorbed, velocities are summed,
// contacts evaluated as above, and groups linearised. The momentum does not change.

void absorb_increments(const ContactProblem& problem, Index first_block, Index last_block, Linearisation& w);
void absorb_velocities(Index first, Index last, Linearisation& w);
void linearise_groups(const ContactProblem& problem, Index first_block, Index last_block, Linearisation& w);

/// Adds P0 to the mean of its last values, as the count-th of them. mean.pn, pt and pr must have their sizes.
void average_impulses(const ContactProblem& problem, Index first_block, Index last_block,
                      const Linearisation& w, int count, ContactSolution& mean);

/// Copies P0 to the solution.
void unload_impulses(const ContactProblem& problem, Index first_block, Index last_block,
                     const Linearisation& w, ContactSolution& solution);
/// Copies the velocities at P0 to the solution.
void unload_velocities(const ContactProblem& problem, Index first, Index last, const Linearisation& w,
                       ContactSolution& solution);

/// Return the arrays of groups and rows on which the kernels of a sweep work.
ContactArrays contact_arrays(Linearisation& w);
BodyArrays body_arrays(Linearisation& w);

}  // namespace talus::solver
