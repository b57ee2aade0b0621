#pragma once
/// Signorini's condition (T9) and Coulomb's law (T10), exact for one contact.

#include <algorithm>
#include <cmath>

namespace talus {

struct Impulse {
  double normal = 0.0;
  double tangential = 0.0;
};

/// The nearest impulse that the contact law admits: P_n >= 0, |P_t| <= mu P_n. The cone is cut along the
/// tangent, as Coulomb's law has it, not projected on orthogonally: that would be an associated law with
/// dilating sliding.
inline Impulse admissible(double pn, double pt, double mu) {
  const double normal = pn > 0.0 ? pn : 0.0;
  const double bound = mu * normal;
  return {normal, std::min(std::max(pt, -bound), bound)};
}

/// The impulse that solves one contact exactly, all others held (T13), from the present impulse and relative
/// velocity; w_n and w_t are the inverse of the Delassus diagonal, kg.
inline Impulse solve_contact(double pn, double pt, double un, double ut, double w_n, double w_t, double mu) {
  return admissible(pn - un * w_n, pt - ut * w_t, mu);
}

}  // namespace talus
