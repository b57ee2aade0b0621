#pragma once
/// The two precisions of the accelerated solver. Impulses P0, velocities and the residual are double; the
/// iterations look for an increment p = P - P0 in single precision, at half the bytes and twice the lanes. P0
/// is moved to P0 + p now and then, so nothing is lost to single precision, whatever the tolerance.
/// (Mixed-precision iterative refinement, Wilkinson 1963.)

#include <cstdint>
#include <vector>

#include "solver/gradient_kernels.h"
#include "solver/problem.h"
#include "solver/residual.h"

namespace talus {

/// Velocity of a body, or impulse of a contact in the axes of the bed; the spin is r omega.
struct ExactRow {
  double x = 0.0, y = 0.0, spin = 0.0;
};

/// Arrays kept between solves. Contacts are padded to whole groups.
struct Linearisation {
  // Single precision: what the iterations work on.
  std::vector<ContactGroup> contacts;
  std::vector<ImpulseGroup> increment, ahead;
  std::vector<ForceGroup> force;
  std::vector<Row> mobility, velocity;
  std::vector<Index> first_a, first_b;
  std::vector<std::uint32_t> b_force;
  // Double precision, at P0.
  std::vector<double> pn, pt, wn, wt;
  std::vector<ExactRow> exact_force, exact_velocity;
  std::vector<ResidualSums> sums;  ///< one for each block of contacts
  // What b_force was made for.
  std::vector<Index> linked_a, linked_b;
  /// Units of the single precision: impulse (N s), and velocity (m/s) that it gives a mean body.
  double impulse_unit = 1.0, velocity_unit = 1.0, mobility_unit = 1.0;
};

/// Sizes the arrays, links bodies to their contacts, and takes P0 from the guess. Contacts are not loaded
/// yet.
void prepare(const ContactProblem& problem, const ContactSolution& guess, Linearisation& w);

// What follows is shared out: each member of a team takes some blocks of contacts or some bodies, and waits
// for the others before the next part.

/// Loads contacts, without increments, and makes the guess admissible.
void load_contacts(const ContactProblem& problem, Index first_block, Index last_block, Linearisation& w);

// P0 moves to P0 + p in three parts. y, and with it the momentum, stays where it was.

void absorb_increments(const ContactProblem& problem, Index first_block, Index last_block, Linearisation& w);
void sum_exact_velocities(const ContactProblem& problem, Index first, Index last, Linearisation& w);
void linearise_contacts(const ContactProblem& problem, Index first_block, Index last_block, Linearisation& w);

/// The natural-map residual at P0, as natural_map_residual has it.
struct ExactResidual {
  Residual residual;
  double norm = 0.0;  ///< || P0 ||, or || P' || where P0 vanishes, in impulse units
  bool cold = true;   ///< P0 vanishes
};
ExactResidual exact_residual(const Linearisation& w);

/// P0 and its velocities.
void unload_solution(const ContactProblem& problem, const Linearisation& w, ContactSolution& solution);

ContactArrays contact_arrays(Linearisation& w);
BodyArrays body_arrays(Linearisation& w);

}  // namespace talus
