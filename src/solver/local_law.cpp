#include "solver/local_law.h"

#include <algorithm>
#include <cmath>

namespace talus::solver {
namespace {

/// Share of the diagonal below which the coupling within a block is round-off.
constexpr double coupling_round_off = 1e-13;

/// Computes sliding with P_t = sign mu P_n; returns whether that is a solution.
bool slides(const LocalContact& contact, RelativeVelocity b, double sign, Impulse& p) {
  const DelassusBlock& w = contact.w;
  const double softness = w.nn + sign * contact.mu * w.nt;
  if (!(softness > 0.0)) return false;
  p.normal = -b.normal / softness;
  p.tangential = sign * contact.mu * p.normal;
  return p.normal >= 0.0 && sign * (b.tangential + w.tn * p.normal + w.tt * p.tangential) <= 0.0;
}

}  // namespace

LocalContact local_contact(const DelassusBlock& w, double mu) {
  LocalContact contact;
  contact.w = w;
  contact.w_n = w.nn > 0.0 ? 1.0 / w.nn : 0.0;
  contact.w_t = w.tt > 0.0 ? 1.0 / w.tt : 0.0;
  contact.mu = mu;
  contact.coupled =
      w.nn > 0.0 && std::max(std::fabs(w.nt), std::fabs(w.tn)) > coupling_round_off * std::max(w.nn, w.tt);
  return contact;
}

std::vector<LocalContact> local_contacts(const LocalProblem& problem) {
  std::vector<LocalContact> contacts;
  contacts.reserve(problem.mu.size());
  for (Index c = 0; c < problem.contact_count(); ++c)
    contacts.push_back(local_contact(problem.block[problem.diagonal[c]], problem.mu[c]));
  return contacts;
}

Impulse solve_coupled_contact(const LocalContact& contact, Impulse p, RelativeVelocity u) {
  const DelassusBlock& w = contact.w;
  const RelativeVelocity b{u.normal - w.nn * p.normal - w.nt * p.tangential,
                           u.tangential - w.tn * p.normal - w.tt * p.tangential};
  if (b.normal >= 0.0) return {};
  const double determinant = w.nn * w.tt - w.nt * w.tn;
  if (determinant > 0.0) {
    const Impulse stick{(w.nt * b.tangential - w.tt * b.normal) / determinant,
                        (w.tn * b.normal - w.nn * b.tangential) / determinant};
    if (stick.normal >= 0.0 && std::fabs(stick.tangential) <= contact.mu * stick.normal) return stick;
  }
  Impulse slide;
  if (slides(contact, b, 1.0, slide) || slides(contact, b, -1.0, slide)) return slide;
  return solve_contact(p.normal, p.tangential, u.normal, u.tangential, contact.w_n, contact.w_t, contact.mu);
}

Residual natural_map_residual(const LocalProblem& problem, const LocalSolution& solution) {
  ResidualSums sums;
  for (Index c = 0; c < problem.contact_count(); ++c) {
    const LocalContact contact = local_contact(problem.block[problem.diagonal[c]], problem.mu[c]);
    sums.add(solution.p[c], solve_local_contact(contact, solution.p[c], solution.u[c]));
  }
  return sums.residual();
}

}  // namespace talus::solver
