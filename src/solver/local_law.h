#pragma once
/// The contact law for one block of a local problem, and its residual.

#include "solver/local_problem.h"
#include "solver/residual.h"

namespace talus::solver {

/// One contact of a local problem, ready to be solved with all others held.
struct LocalContact {
  DelassusBlock w;              ///< its block on the diagonal of W
  double w_n = 0.0, w_t = 0.0;  ///< kg: inverse of the diagonal of that block; 0 where that is not positive
  double mu = 0.0;
  bool coupled = false;  ///< a normal impulse gives a tangential velocity, beyond round-off
};
LocalContact local_contact(const DelassusBlock& w, double mu);
std::vector<LocalContact> local_contacts(const LocalProblem& problem);

/// The exact solution of one contact for b = U - w P, the velocity that the others give it. Tried in turn:
///   open   P = 0, where b_n >= 0
///   stick  P = -w^-1 b, where P_n >= 0 and |P_t| <= mu P_n
///   slide  P_t = s mu P_n with P_n = -b_n / (w_nn + s mu w_nt), s = +1 and -1, where P_n >= 0 and s U_t <= 0
/// Exactly one case fits where w is positive definite and mu |w_nt| < w_nn. Where none does, the contact is
/// solved as if it were not coupled.
Impulse solve_coupled_contact(const LocalContact& contact, Impulse p, RelativeVelocity u);

/// The impulse that solves one contact exactly, all others held, from its present impulse and velocity.
inline Impulse solve_local_contact(const LocalContact& contact, Impulse p, RelativeVelocity u) {
  if (contact.coupled) return solve_coupled_contact(contact, p, u);
  return solve_contact(p.normal, p.tangential, u.normal, u.tangential, contact.w_n, contact.w_t, contact.mu);
}

/// The measure of residual.h for a problem in local form; `solution` holds impulses and their velocities.
Residual natural_map_residual(const LocalProblem& problem, const LocalSolution& solution);

}  // namespace talus::solver
