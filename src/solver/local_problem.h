#pragma once
/// A contact problem in local form, with W, q and mu only and without bodies, and the contact law for one
/// contact of it. Problems of other programs come in this form.

#include <vector>

#include "solver/problem.h"

namespace talus::solver {

/// A 2 x 2 block of the Delassus operator, 1/kg, column by column: `tn` is the tangential velocity due to a
/// unit normal impulse.
struct DelassusBlock {
  double nn = 0.0, tn = 0.0;
  double nt = 0.0, tt = 0.0;
};

/// A problem whose unknown impulses P_c = (P_n, P_t) and relative velocities U = W P + q must satisfy the
/// contact law of ContactProblem. W is stored in block rows.
struct LocalProblem {
  std::vector<Index> row_begin;      ///< blocks of contact c: row_begin[c] ... row_begin[c + 1] - 1
  std::vector<Index> column;         ///< contact of each block, ascending within a row
  std::vector<DelassusBlock> block;  ///< 1/kg
  std::vector<Index> diagonal;       ///< position of the block of c with itself; every row has one
  std::vector<RelativeVelocity> q;   ///< m/s, relative velocity without impulses
  std::vector<double> mu;

  Index contact_count() const { return mu.size(); }
};

/// Impulses, N s, and the relative velocities U = W P + q, m/s.
struct LocalSolution {
  std::vector<Impulse> p;           ///< input: first guess; output: solution
  std::vector<RelativeVelocity> u;  ///< output only
};

/// An entry of W as a scalar matrix; row and column 2 c belong to the normal of contact c, 2 c + 1 to its
/// tangent.
struct MatrixEntry {
  Index row = 0;
  Index column = 0;
  double value = 0.0;
};

/// Returns the problem with the given entries of W, in any order; entries at the same position are added.
LocalProblem local_problem(std::vector<MatrixEntry> entries, std::vector<RelativeVelocity> q,
                           std::vector<double> mu);

/// Returns the local form of a problem with bodies, W = H^T M^-1 H and q = H^T v_free + c (T7).
LocalProblem local_problem(const ContactProblem& problem);
/// Returns the local form of a solution with bodies: its impulses and relative velocities.
LocalSolution local_form(const ContactProblem& problem, const ContactSolution& solution);

/// Returns U_c = (W P + q)_c.
inline RelativeVelocity relative_velocity(const LocalProblem& problem, const std::vector<Impulse>& p,
                                          Index c) {
  RelativeVelocity u = problem.q[c];
  for (Index k = problem.row_begin[c]; k < problem.row_begin[c + 1]; ++k) {
    const DelassusBlock& w = problem.block[k];
    const Impulse& impulse = p[problem.column[k]];
    u.normal += w.nn * impulse.normal + w.nt * impulse.tangential;
    u.tangential += w.tn * impulse.normal + w.tt * impulse.tangential;
  }
  return u;
}

/// Computes U = W P + q at every contact.
void velocities_from_impulses(const LocalProblem& problem, LocalSolution& solution);

// The contact law for one contact of a local problem, and the residual of such a problem.

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

/// Returns the residual of problem.h for a problem in local form; `solution` holds impulses and their
/// velocities.
Residual natural_map_residual(const LocalProblem& problem, const LocalSolution& solution);

}  // namespace talus::solver
