#include "solver/balance.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace talus::solver {
namespace {

/// Returns the problem without demanded velocities; open contacts stay open.
ContactProblem without_demands(ContactProblem problem) {
  for (double& cn : problem.cn) cn = std::max(cn, 0.0);
  std::ranges::fill(problem.ct, 0.0);
  return problem;
}

std::vector<DelassusDiagonal> diagonals(const ContactProblem& problem) {
  std::vector<DelassusDiagonal> w;
  for (Index c = 0; c < problem.contact_count(); ++c) w.push_back(delassus_diagonal(problem, c));
  return w;
}

/// Estimates the largest eigenvalue of D^-1 W from below by power iteration; D is the diagonal of W.
double largest_eigenvalue(ContactProblem problem, const std::vector<DelassusDiagonal>& w,
                          ContactSolution vector) {
  constexpr int iterations = 60;
  for (auto* field : {&problem.vx, &problem.vy, &problem.omega, &problem.cn}) std::ranges::fill(*field, 0.0);
  // Signs that alternate between contacts, so that the start is far from any smooth mode.
  for (std::size_t c = 0; c < w.size(); ++c) vector.pn[c] = vector.pt[c] = c % 2 == 0 ? 1.0 : -1.0;
  double norm = 1.0;
  for (int k = 0; k < iterations; ++k) {
    velocities_from_impulses(problem, vector);
    double square = 0.0, before = 0.0;
    for (std::size_t c = 0; c < w.size(); ++c) {
      const RelativeVelocity u = relative_velocity(problem, vector, static_cast<Index>(c));
      before += vector.pn[c] * vector.pn[c] + vector.pt[c] * vector.pt[c];
      vector.pn[c] = u.normal / w[c].normal;
      vector.pt[c] = u.tangential / w[c].tangential;
      square += vector.pn[c] * vector.pn[c] + vector.pt[c] * vector.pt[c];
    }
    norm = std::sqrt(square / before);
    for (auto* field : {&vector.pn, &vector.pt})
      for (double& value : *field) value /= std::sqrt(square);
  }
  return norm;
}

/// Replaces (pn, pt) by the nearest point of the cone |P_t| <= mu P_n, with tangential lengths multiplied by
/// `stretch`.
void project(double mu, double stretch, double& pn, double& pt) {
  const double slope = mu * stretch, side = std::fabs(pt) * stretch;
  if (side <= slope * pn) return;
  const double along = (pn + slope * side) / (1.0 + slope * slope);
  pn = std::max(along, 0.0);
  pt = std::copysign(mu * pn, pt);
}

/// Makes one projected gradient step from `at`, whose velocities must be set; `next` receives impulses only.
void descend(const ContactProblem& problem, const std::vector<DelassusDiagonal>& w, double step,
             const ContactSolution& at, ContactSolution& next) {
  for (std::size_t c = 0; c < w.size(); ++c) {
    next.pn[c] = next.pt[c] = 0.0;
    if (problem.cn[c] > 0.0) continue;
    const RelativeVelocity u = relative_velocity(problem, at, static_cast<Index>(c));
    next.pn[c] = at.pn[c] - step * u.normal / w[c].normal;
    next.pt[c] = at.pt[c] - step * u.tangential / w[c].tangential;
    project(problem.mu[c], std::sqrt(w[c].tangential / w[c].normal), next.pn[c], next.pt[c]);
  }
}

/// Whether the momentum points uphill: the step from `at` to `next` opposes the move from `last` to `next`.
bool uphill(const std::vector<DelassusDiagonal>& w, const ContactSolution& last, const ContactSolution& at,
            const ContactSolution& next) {
  double product = 0.0;
  for (std::size_t c = 0; c < w.size(); ++c)
    product += w[c].normal * (at.pn[c] - next.pn[c]) * (next.pn[c] - last.pn[c]) +
               w[c].tangential * (at.pt[c] - next.pt[c]) * (next.pt[c] - last.pt[c]);
  return product > 0.0;
}

/// Returns the residual of residual.h for the projected gradient step of length 1. `scratch` is working
/// memory.
Residual residual_of(const ContactProblem& problem, const std::vector<DelassusDiagonal>& w,
                     const ContactSolution& solution, ContactSolution& scratch) {
  descend(problem, w, 1.0, solution, scratch);
  ResidualSums sums;
  for (std::size_t c = 0; c < w.size(); ++c)
    sums.add({solution.pn[c], solution.pt[c]}, {scratch.pn[c], scratch.pt[c]});
  return sums.residual();
}

void extrapolate(double momentum, const ContactSolution& last, const ContactSolution& next,
                 ContactSolution& at) {
  for (std::size_t c = 0; c < at.pn.size(); ++c) {
    at.pn[c] = next.pn[c] + momentum * (next.pn[c] - last.pn[c]);
    at.pt[c] = next.pt[c] + momentum * (next.pt[c] - last.pt[c]);
  }
}

}  // namespace

SolverReport balance(const ContactProblem& problem, double tolerance, int max_iterations,
                     ContactSolution& solution) {
  constexpr int iterations_between_checks = 20;
  const ContactProblem still = without_demands(problem);
  const std::vector<DelassusDiagonal> w = diagonals(still);
  const double step = 0.9 / largest_eigenvalue(still, w, solution);
  SolverReport report;
  ContactSolution at = solution, next = solution;
  double t = 1.0;
  for (;; ++report.iterations) {
    if (report.iterations % iterations_between_checks == 0 || report.iterations >= max_iterations) {
      velocities_from_impulses(still, solution);
      report.residual = residual_of(still, w, solution, next);
      if (report.residual.eta <= tolerance || report.iterations >= max_iterations) break;
    }
    velocities_from_impulses(still, at);
    descend(still, w, step, at, next);
    if (uphill(w, solution, at, next)) t = 1.0;
    const double t_next = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * t * t));
    extrapolate((t - 1.0) / t_next, solution, next, at);
    std::swap(solution.pn, next.pn);
    std::swap(solution.pt, next.pt);
    t = t_next;
  }
  report.converged = report.residual.eta <= tolerance;
  return report;
}

}  // namespace talus::solver
