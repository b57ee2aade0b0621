#pragma once
/// The two precisions of the accelerated solver. Impulses P0, velocities and the residual are double; the
/// sweeps look for an increment p = P - P0 in single precision, at half the bytes and twice the lanes. P0
/// is moved to P0 + p now and then, so nothing is lost to single precision, whatever the tolerance.
/// (Mixed-precision iterative refinement, Wilkinson 1963.)

#include <cstdint>
#include <vector>

#include "base/thread_team.h"
#include "solver/problem.h"
#include "solver/residual.h"
#include "solver/rolling_contacts.h"
#include "solver/sweep_kernels.h"
#include "solver/sweep_order.h"

namespace talus::solver {

/// Contacts are shared out in blocks of this many; the sums of a block do not depend on who computes them.
inline constexpr Index contacts_per_block = 512;

struct BlockSums {
  ResidualSums residual;
  Index pressed = 0;  ///< contacts that are not swept and whose bodies approach each other
};

/// Arrays kept between solves.
struct Linearisation {
  // Double precision, at P0, in the order of the problem.
  std::vector<double> pn, pt, un, ut, wn, wt;
  std::vector<ExactRow> exact_force;  ///< of one contact more than there are, without an impulse
  std::vector<ExactRow> exact_velocity;
  std::vector<BlockSums> sums;
  /// Body i is the first body of contacts first_a[i] ... first_a[i + 1] - 1. All its contacts c are listed in
  /// entries first_side[i] ... first_side[i + 1] - 1 of sides: as 2 c where it is the second body, then, from
  /// first_own_side[i] on, as 2 c + 1 where it is the first, and up to a multiple of sides_at_once the
  /// contact after the last.
  std::vector<Index> first_a, first_side, first_own_side, next_side;
  std::vector<std::uint32_t> sides;
  std::vector<std::uint8_t> moves;  ///< whether anything moves the body
  std::vector<std::uint8_t> swept;  ///< whether the contact takes part in the sweeps

  // Single precision, in the order of the sweep.
  SweepOrder order;
  std::vector<ContactGroup> contacts;
  std::vector<UnlikeGroup> unlike;  ///< empty where contacts are alike
  std::vector<ImpulseGroup> increment, last_move;
  std::vector<Row> velocity, before;

  RollingContacts rolling;  ///< empty where no contact resists rolling

  // What was computed for the contacts and bodies of the last problem is good for this one where they are the
  // same, as in most steps of a quiet bed.
  ContactProblem linked;                    ///< without velocities, normals and c
  std::vector<std::uint8_t> ordered_swept;  ///< what the order was made for; empty: none
  bool are_new = true;                      ///< contacts or bodies are not those of the last problem
  bool are_loaded = false;     ///< what follows from contacts and bodies is there; not after a failure
  bool have_new_order = true;  ///< nothing that was loaded into groups can stay
  /// Units of the single precision: impulse (N s), and velocity (m/s) that it gives a mean body.
  double impulse_unit = 1.0, velocity_unit = 1.0, mobility_unit = 1.0;
  Index moving = 0;  ///< bodies with a mass
  /// All contacts have the same friction, and all bodies are disks in single precision: r^2 / I is 2 / m, or
  /// both vanish.
  bool are_alike = false;
};

/// Sizes the arrays, links bodies to their contacts, and chooses the units. The team helps, if there is one.
void prepare(const ContactProblem& problem, const ContactSolution& guess, ThreadTeam* team, Linearisation& w);

// What follows is shared out, but for the begin and the end of an order: each member of a team takes some
// blocks of contacts or some bodies, and waits for the others before the next part.

/// P0 becomes these impulses, made admissible.
void load_contacts(const ContactProblem& problem, const ContactSolution& impulses, Index first_block,
                   Index last_block, Linearisation& w);
void sum_exact_velocities(const ContactProblem& problem, const SweepKernels& kernels, Index first, Index last,
                          Linearisation& w);
/// Relative velocities at P0 and sums of blocks.
void look_at_contacts(const ContactProblem& problem, const SweepKernels& kernels, Index first_block,
                      Index last_block, Linearisation& w);

/// The natural-map residual at P0, as natural_map_residual has it.
struct ExactResidual {
  Residual residual;
  double norm = 0.0;  ///< || P0 ||, or || P' || where P0 vanishes, in impulse units
  bool cold = true;   ///< P0 vanishes
  Index pressed = 0;  ///< as in BlockSums
};
ExactResidual exact_residual(const Linearisation& w);

/// Chooses the contacts to sweep at first: those with an impulse, and those that may close while the
/// velocities change. Where another one would, it shows: it is pressed.
void choose_swept(const ContactProblem& problem, Index first_block, Index last_block, Linearisation& w);
/// Adds the pressed contacts.
void add_pressed(const ContactProblem& problem, Index first_block, Index last_block, Linearisation& w);
/// The contacts to be swept are put in their order, unless they are: then there is no new order, and nothing
/// to go on with but to load groups. One member begins this for all, and ends it.
void begin_order_of_contacts(const ContactProblem& problem, int size, Linearisation& w);
void end_order_of_contacts(const ContactProblem& problem, Linearisation& w);
/// Loads what is swept, around P0, without increments.
void load_groups(const ContactProblem& problem, Index first_block, Index last_block, Linearisation& w);
void clear_rows(Index first, Index last, Linearisation& w);

// P0 moves to P0 + p in five parts: increments and velocities are absorbed, then velocities summed and
// contacts looked at as above, then linearised. The momentum stays what it was.

void absorb_increments(const ContactProblem& problem, Index first_block, Index last_block, Linearisation& w);
void absorb_velocities(Index first, Index last, Linearisation& w);
void linearise_groups(const ContactProblem& problem, Index first_block, Index last_block, Linearisation& w);

/// Takes P0 into the mean of its last values, as the count-th of them. mean.pn, pt, and pr have their sizes.
void average_impulses(const ContactProblem& problem, Index first_block, Index last_block,
                      const Linearisation& w, int count, ContactSolution& mean);

/// P0.
void unload_impulses(const ContactProblem& problem, Index first_block, Index last_block,
                     const Linearisation& w, ContactSolution& solution);
/// Its velocities.
void unload_velocities(const ContactProblem& problem, Index first, Index last, const Linearisation& w,
                       ContactSolution& solution);

ContactArrays contact_arrays(Linearisation& w);
BodyArrays body_arrays(Linearisation& w);

}  // namespace talus::solver
