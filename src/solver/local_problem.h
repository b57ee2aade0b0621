#pragma once
/// A contact problem in local form, with W, q and mu only and without bodies. Problems of other programs come
/// in this form.

#include <vector>

#include "solver/contact_law.h"
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

  Index contact_count() const { return static_cast<Index>(mu.size()); }
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

}  // namespace talus::solver
