#pragma once
/// The contact problem of one step, as seen by the solvers, which know neither grains nor geometry; its law;
/// and the error measure of all solvers.

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/types.h"

namespace talus::solver {

// Signorini's condition (T9), Coulomb's law (T10) and rolling resistance (T38), exact for one contact.

struct Impulse {
  double normal = 0.0;
  double tangential = 0.0;
};

/// Returns the nearest impulse that the contact law admits: P_n >= 0, |P_t| <= mu P_n. P_t is cut off at the
/// bound, following Coulomb's law. An orthogonal projection on the cone would be an associated law, with
/// dilatant sliding.
inline Impulse admissible(double pn, double pt, double mu) {
  const double normal = pn > 0.0 ? pn : 0.0;
  const double bound = mu * normal;
  return {normal, std::min(std::max(pt, -bound), bound)};
}

/// Returns the impulse that solves one contact exactly with all others held fixed (T13), from the present
/// impulse and relative velocity; w_n and w_t are the inverse of the Delassus diagonal, kg.
inline Impulse solve_contact(double pn, double pt, double un, double ut, double w_n, double w_t, double mu) {
  return admissible(pn - un * w_n, pt - ut * w_t, mu);
}

/// Returns the nearest rolling impulse that a contact with normal impulse `pn` >= 0 admits: |P_r| <= mu_r
/// P_n.
inline double admissible_rolling(double pr, double mu_r, double pn) {
  const double bound = mu_r * pn;
  return std::min(std::max(pr, -bound), bound);
}

/// Returns the rolling impulse that solves its condition (T40) with all other impulses held fixed; w_r is
/// 1 / W_rr, kg.
inline double solve_rolling(double pr, double ur, double w_r, double mu_r, double pn) {
  return admissible_rolling(pr - ur * w_r, mu_r, pn);
}

/// A problem of bodies i with velocity (v_x, v_y, omega) and contacts c between bodies a and b with normal n
/// (from a to b) and tangent t = (-n_y, n_x). The unknowns are the impulses P = (P_n, P_t) on b. With
/// v = v_free + M^-1 H P (T6), the relative velocities U = H^T v + c (T5),
///   U_n = (v_b - v_a) . n + c_n
///   U_t = (v_b - v_a) . t - (r_b omega_b + r_a omega_a) + c_t
/// must satisfy Signorini's condition (T9), 0 <= U_n complementary to P_n >= 0, and Coulomb's law (T10),
/// |P_t| <= mu P_n with sliding opposing P_t. c contains gaps and restitution. All quantities are per metre
/// of thickness.
///
/// If contacts resist rolling, a third unknown is the rolling impulse P_r: the impulse of the moment that the
/// contact exerts on b (and its opposite on a), divided by the length l = r_a + r_b. Its relative velocity
/// U_r = l (omega_b - omega_a) must satisfy (T38), |P_r| <= mu_r P_n with rolling opposing P_r.
struct ContactProblem {
  // Bodies.
  std::vector<double> vx, vy, omega;    ///< free velocity, m/s and rad/s
  std::vector<double> inverse_mass;     ///< 1/kg; 0 for a body that does not move
  std::vector<double> inverse_inertia;  ///< 1/(kg m^2); 0 for a body that does not rotate
  std::vector<double> lever;  ///< r, m: distance from the centre to every contact of the body; 0 for a plane
  /// Column of the bed in which the body is, 0 ... columns - 1 from one end to the other. Contacts join
  /// bodies of the same column, of two adjacent columns, or of the first and the last, so that a solver may
  /// work on several columns simultaneously. The value of a body that does not move is ignored. Empty in
  /// small beds, and if unknown.
  std::vector<Index> column;
  Index columns = 0;

  // Contacts.
  std::vector<Index> a, b;
  std::vector<double> nx, ny;
  std::vector<double> cn, ct;  ///< m/s
  std::vector<double> mu;
  std::vector<double> rolling_friction;  ///< mu_r; empty if no contact resists rolling

  Index body_count() const { return vx.size(); }
  Index contact_count() const { return a.size(); }
  bool resists_rolling() const { return !rolling_friction.empty(); }
};

/// Impulses, N s, and the velocities that they give the bodies.
struct ContactSolution {
  std::vector<double> pn, pt;         ///< impulses; input: first guess; output: solution
  std::vector<double> pr;             ///< rolling impulses, likewise; empty if no contact resists rolling
  std::vector<double> vx, vy, omega;  ///< output: v = v_free + M^-1 H P
};

/// Returns r^2 / I, 1/kg: the amount by which a unit of P_t reduces the spin r omega of a body.
inline double spin_mobility(const ContactProblem& problem, Index body) {
  return problem.lever[body] * problem.lever[body] * problem.inverse_inertia[body];
}

/// Diagonal of the Delassus operator W = H^T M^-1 H at contact c (T8); for disks its 2 x 2 block is diagonal.
/// W_nn = 1/m_a + 1/m_b, W_tt = W_nn + r_a^2 / I_a + r_b^2 / I_b. 1/kg.
struct DelassusDiagonal {
  double normal = 0.0;
  double tangential = 0.0;
};
inline DelassusDiagonal delassus_diagonal(const ContactProblem& problem, Index c) {
  const Index a = problem.a[c], b = problem.b[c];
  const double normal = problem.inverse_mass[a] + problem.inverse_mass[b];
  return {normal, normal + (spin_mobility(problem, a) + spin_mobility(problem, b))};
}

/// Relative velocity U at a contact for given body velocities (T5).
struct RelativeVelocity {
  double normal = 0.0;
  double tangential = 0.0;
};
RelativeVelocity relative_velocity(const ContactProblem& problem, const ContactSolution& at, Index c);

/// Returns the length l = r_a + r_b of contact c, m; r_a if b is a plane (T38).
double rolling_length(const ContactProblem& problem, Index c);

/// Returns 1 / W_rr, kg, with W_rr = l^2 (1/I_a + 1/I_b) (T39); 0 between bodies that do not rotate.
double inverse_rolling_delassus(const ContactProblem& problem, Index c);

/// Returns U_r = l (omega_b - omega_a), m/s (T38).
double rolling_velocity(const ContactProblem& problem, const ContactSolution& at, Index c);

/// Returns q_c = (H^T v_free + c)_c (T7), the value of U = W P + q at contact c without impulses.
RelativeVelocity free_relative_velocity(const ContactProblem& problem, Index c);

/// Computes v = v_free + M^-1 H P (T6), summed contact by contact in their order.
void velocities_from_impulses(const ContactProblem& problem, ContactSolution& solution);

// The error measure of all solvers.

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
