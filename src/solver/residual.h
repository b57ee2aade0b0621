#pragma once
/// The error measure of all solvers.

#include <algorithm>

#include "solver/contact_law.h"
#include "solver/problem.h"

namespace talus::solver {

struct Residual {
  double eta = 0.0;      ///< || P' - P || / || P ||, dimensionless
  double largest = 0.0;  ///< largest | P' - P | / || P || of a single contact
};

/// Sums over contacts from which the residual is computed.
struct ResidualSums {
  double change = 0.0;                        ///< || P' - P ||^2
  double impulse = 0.0, impulse_after = 0.0;  ///< || P ||^2 and || P' ||^2
  double largest = 0.0;                       ///< largest | P' - P |^2 of a single contact

  /// Adds a contact whose exact solution changes its impulse from `from` to `to`.
  void add(Impulse from, Impulse to) { add(from, to, 0.0, 0.0); }
  /// Adds a contact with its rolling impulse.
  void add(Impulse from, Impulse to, double rolling_from, double rolling_to) {
    const double dn = to.normal - from.normal;
    const double dt = to.tangential - from.tangential;
    const double dr = rolling_to - rolling_from;
    const double square = dn * dn + dt * dt + dr * dr;
    change += square;
    largest = std::max(largest, square);
    impulse += from.normal * from.normal + from.tangential * from.tangential + rolling_from * rolling_from;
    impulse_after += to.normal * to.normal + to.tangential * to.tangential + rolling_to * rolling_to;
  }

  /// Returns || P ||^2, or || P' ||^2 if P vanishes.
  double scale() const { return impulse > 0.0 ? impulse : impulse_after; }
  Residual residual() const;  ///< (T14)
};

/// Returns the natural-map residual (T14). P' is the result of one Jacobi step: every contact is solved
/// exactly with all others held fixed; if contacts resist rolling, each of its impulses with the others held
/// fixed (T40). The residual vanishes exactly at a solution. If P vanishes and P' does not, the norm of P'
/// replaces that of P. `solution` must hold impulses and the velocities that belong to them.
Residual natural_map_residual(const ContactProblem& problem, const ContactSolution& solution);

}  // namespace talus::solver
