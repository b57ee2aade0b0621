#pragma once
/// What the accelerated solver keeps of contacts that resist rolling, beside the Linearisation of their
/// forces (solver/linearisation.h): the rolling impulse P_r in both precisions.

#include <vector>

#include "solver/problem.h"
#include "solver/sweep_kernels.h"

namespace talus::solver {

struct RollingContacts {
  // Double precision, at P0, in the order of the problem.
  std::vector<double> pr, ur, wr, length;
  // Single precision, in the order of the sweep.
  std::vector<RollingGroup> groups;
  std::vector<RollingImpulses> increment, last_move;
  double unit_length = 1.0;  ///< m: the turn of a row is omega times this

  bool are_there() const { return !pr.empty(); }
};

/// The unit of lengths, and the units of a Linearisation, the first two inverse.
struct RollingUnits {
  double length, per_impulse, per_velocity, mobility;
};

/// Sizes the arrays of the contacts, and chooses the unit of lengths.
void size_rolling(const ContactProblem& problem, RollingContacts& w);

/// What contact c keeps as long as contacts and bodies stay the same.
void load_rolling(const ContactProblem& problem, std::size_t c, RollingContacts& w);

/// Loads what the groups of an order keep: its mobilities.
void load_rolling_group(const ContactProblem& problem, std::size_t c, Index slot, const RollingUnits& units,
                        RollingContacts& w);
/// No increment, no momentum.
void start_rolling(Index slot, RollingContacts& w);
/// Relative velocity at P0, and what is left until the contact rolls.
void linearise_rolling(const ContactProblem& problem, std::size_t c, Index slot, double pn,
                       const RollingUnits& units, RollingContacts& w);
/// P0_r + p_r; the increment becomes zero.
double take_rolling_increment(std::size_t c, Index slot, double impulse_unit, RollingContacts& w);

/// Adds the fields of these contacts to those that the residual is computed from.
void take_rolling(const ContactProblem& problem, RollingContacts& w, LookArrays& arrays);

}  // namespace talus::solver
