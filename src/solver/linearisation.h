#pragma once
/// The two precisions of the accelerated solver. The impulses P0, the velocities and the residual are in
/// double precision. The sweeps search for an increment p = P - P0 in single precision, with half the bytes
/// and twice the lanes. P0 is replaced by P0 + p from time to time, so that any tolerance can be reached
/// (mixed-precision iterative refinement, Wilkinson 1963).

#include <cstdint>
#include <vector>

#include "base/thread_team.h"
#include "solver/problem.h"
#include "solver/residual.h"
#include "solver/rolling_contacts.h"
#include "solver/sweep_kernels.h"
#include "solver/sweep_order.h"

namespace talus::solver {

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
