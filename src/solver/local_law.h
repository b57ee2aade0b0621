#pragma once
/// The contact law for one contact of a local problem, and the residual of such a problem.

#include "solver/local_problem.h"
#include "solver/residual.h"

namespace talus::solver {

/// One contact of a local problem, prepared to be solved with all others held fixed.
struct LocalContact {
  DelassusBlock w;              ///< its block on the diagonal of W
  double w_n = 0.0, w_t = 0.0;  ///< kg: inverse of the diagonal of that block; 0 if that is not positive
  double mu = 0.0;
  bool coupled = false;  ///< whether a normal impulse gives a tangential velocity beyond round-off
};
LocalContact local_contact(const DelassusBlock& w, double mu);
std::vector<LocalContact> local_contacts(const LocalProblem& problem);

/// Returns the exact solution of one contact for b = U - w P, the velocity that the others give it. Tried in
/// turn:
///   open   P = 0, if b_n >= 0
///   stick  P = -w^-1 b, if P_n >= 0 and |P_t| <= mu P_n
///   slide  P_t = s mu P_n with P_n = -b_n / (w_nn + s mu w_nt), s = +1 and -1, if P_n >= 0 and s U_t <= 0
/// Exactly one case applies if w is positive definite and mu |w_nt| < w_nn. If none does, the contact is
/// solved as if it were not coupled.
Impulse solve_coupled_contact(const LocalContact& contact, Impulse p, RelativeVelocity u);

/// Returns the impulse that solves one contact exactly with all others held fixed, from its present impulse
/// and velocity.
inline Impulse solve_local_contact(const LocalContact& contact, Impulse p, RelativeVelocity u) {
  if (contact.coupled) return solve_coupled_contact(contact, p, u);
  return solve_contact(p.normal, p.tangential, u.normal, u.tangential, contact.w_n, contact.w_t, contact.mu);
}

/// Returns the residual of residual.h for a problem in local form; `solution` holds impulses and their
/// velocities.
Residual natural_map_residual(const LocalProblem& problem, const LocalSolution& solution);

}  // namespace talus::solver
