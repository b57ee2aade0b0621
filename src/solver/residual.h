#pragma once
/// The one measure of error, for every solver.

#include <algorithm>

#include "solver/contact_law.h"
#include "solver/problem.h"

namespace talus::solver {

struct Residual {
  double eta = 0.0;      ///< || P' - P || / || P ||, dimensionless
  double largest = 0.0;  ///< the largest single contact's | P' - P | / || P ||
};

/// The sums over contacts that the residual is made of.
struct ResidualSums {
  double change = 0.0;  ///< || P' - P ||^2
  double impulse = 0.0, impulse_after = 0.0;
  double largest = 0.0;

  /// A contact that its exact solution would take from one impulse to another.
  void add(Impulse from, Impulse to) { add(from, to, 0.0, 0.0); }
  /// The same with its rolling impulse.
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

  /// || P ||^2, or || P' ||^2 where P vanishes.
  double scale() const { return impulse > 0.0 ? impulse : impulse_after; }
  Residual residual() const;  ///< (T14)
};

/// Natural-map residual (T14): P' is what one exact local solution of every contact would make of P, all
/// others held (a Jacobi step); where contacts resist rolling, of each of its impulses, the others held
/// (T40). Zero exactly at a solution. Where P vanishes and P' does not, the norm of P' takes its place.
/// `solution` must hold impulses and the velocities that belong to them.
Residual natural_map_residual(const ContactProblem& problem, const ContactSolution& solution);

}  // namespace talus::solver
