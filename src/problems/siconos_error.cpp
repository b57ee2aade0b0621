#include "problems/siconos_error.h"

#include <algorithm>
#include <cmath>

namespace talus::problems {
namespace {

/// Sums of squares over the contacts.
struct Sums {
  double distance = 0.0;
  double impulse = 0.0;
  double velocity = 0.0;
  double free_velocity = 0.0;

  double error() const {
    const double scale = std::sqrt(std::max({impulse, velocity, free_velocity}));
    return scale > 0.0 ? std::sqrt(distance) / scale : 0.0;
  }
};

/// Returns the nearest point of the cone |P_t| <= mu P_n.
solver::Impulse nearest_in_cone(double pn, double pt, double mu) {
  const double tangential = std::fabs(pt);
  if (mu * tangential <= -pn) return {};
  if (tangential <= mu * pn) return {pn, pt};
  const double normal = (mu * tangential + pn) / (mu * mu + 1.0);
  return {normal, std::copysign(mu * normal, pt)};
}

void add_contact(Sums& sums, solver::Impulse p, solver::RelativeVelocity u, solver::RelativeVelocity q,
                 double mu) {
  const solver::Impulse projected =
      nearest_in_cone(p.normal - (u.normal + mu * std::fabs(u.tangential)), p.tangential - u.tangential, mu);
  const double dn = p.normal - projected.normal;
  const double dt = p.tangential - projected.tangential;
  sums.distance += dn * dn + dt * dt;
  sums.impulse += p.normal * p.normal + p.tangential * p.tangential;
  sums.velocity += u.normal * u.normal + u.tangential * u.tangential;
  sums.free_velocity += q.normal * q.normal + q.tangential * q.tangential;
}

}  // namespace

double siconos_error(const solver::LocalProblem& problem, const std::vector<solver::Impulse>& p) {
  Sums sums;
  for (Index c = 0; c < problem.contact_count(); ++c)
    add_contact(sums, p[c], solver::relative_velocity(problem, p, c), problem.q[c], problem.mu[c]);
  return sums.error();
}

double siconos_error(const solver::ContactProblem& problem, const solver::ContactSolution& solution) {
  Sums sums;
  for (Index c = 0; c < problem.contact_count(); ++c)
    add_contact(sums, {solution.pn[c], solution.pt[c]}, solver::relative_velocity(problem, solution, c),
                solver::free_relative_velocity(problem, c), problem.mu[c]);
  return sums.error();
}

}  // namespace talus::problems
