#pragma once
/// The contact problem of one step, as seen by the solvers, which know neither grains nor geometry.

#include <vector>

#include "core/types.h"

namespace talus::solver {

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

  Index body_count() const { return static_cast<Index>(vx.size()); }
  Index contact_count() const { return static_cast<Index>(a.size()); }
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

}  // namespace talus::solver
