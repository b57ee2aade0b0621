#pragma once
/// Signorini's condition (T9), Coulomb's law (T10) and rolling resistance (T38), exact for one contact.

#include <algorithm>
#include <cmath>

namespace talus::solver {

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

}  // namespace talus::solver
