#pragma once
/// Data of the accelerated solver for contacts that resist rolling, in addition to the Linearisation of their
/// forces (solver/linearisation.h): the rolling impulse P_r in both precisions.

#include <vector>

#include "solver/problem.h"
#include "solver/sweep_kernels.h"

namespace talus::solver {

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

}  // namespace talus::solver
