#include "unit/solver/small_problems.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/random.h"
#include "core/trigonometry.h"

namespace talus::test {

void add_body(solver::ContactProblem& problem, double mass, double radius, double vx, double vy,
              double omega) {
  problem.vx.push_back(vx);
  problem.vy.push_back(vy);
  problem.omega.push_back(omega);
  problem.inverse_mass.push_back(mass > 0.0 ? 1.0 / mass : 0.0);
  problem.inverse_inertia.push_back(mass > 0.0 ? 2.0 / (mass * radius * radius) : 0.0);
  problem.lever.push_back(radius);
}

void add_contact(solver::ContactProblem& problem, Index a, Index b, double nx, double ny, double mu,
                 double cn, double ct) {
  problem.a.push_back(a);
  problem.b.push_back(b);
  problem.nx.push_back(nx);
  problem.ny.push_back(ny);
  problem.mu.push_back(mu);
  problem.cn.push_back(cn);
  problem.ct.push_back(ct);
}

solver::ContactProblem one_contact(double vx, double mu, bool swapped) {
  solver::ContactProblem problem;
  add_body(problem, 2.0, 0.1, vx, -1.0, 0.0);
  add_body(problem, 0.0, 0.2, 0.0, 0.0, 0.0);
  add_contact(problem, swapped ? 1 : 0, swapped ? 0 : 1, 0.0, swapped ? 1.0 : -1.0, mu);
  return problem;
}

solver::ContactProblem random_problem(std::uint64_t seed, Index bodies, Index contacts) {
  Random random(seed);
  solver::ContactProblem problem;
  for (Index i = 0; i < bodies; ++i) {
    const bool fixed = i % 5 == 4;
    add_body(problem, fixed ? 0.0 : random.uniform(0.5, 2.0), random.uniform(0.5, 2.0),
             random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
  }
  const auto count = static_cast<std::uint32_t>(bodies);
  while (problem.contact_count() < contacts) {
    const auto a = static_cast<Index>(random.below(count));
    const auto b = static_cast<Index>(random.below(count));
    if (a >= b || a % 5 == 4) continue;  // there is no contact between two fixed bodies
    const double angle = random.uniform(-pi, pi);
    add_contact(problem, a, b, std::cos(angle), std::sin(angle), 0.5, random.uniform(-0.1, 0.1),
                random.uniform(-0.1, 0.1));
  }
  return problem;
}

solver::ContactProblem columns_problem(std::uint64_t seed, Index columns, Index bodies_each) {
  Random random(seed);
  solver::ContactProblem problem;
  problem.columns = columns;
  std::vector<Index> next(static_cast<std::size_t>(columns));  // in shuffled order, different for each layer
  std::iota(next.begin(), next.end(), 0);
  std::vector<std::vector<Index>> ids(next.size());
  for (Index layer = 0; layer < bodies_each; ++layer) {
    for (std::size_t k = next.size() - 1; k > 0; --k)
      std::swap(next[k], next[random.below(static_cast<std::uint32_t>(k) + 1)]);
    for (const Index column : next) {
      ids[static_cast<std::size_t>(column)].push_back(problem.body_count());
      problem.column.push_back(column);
      add_body(problem, layer == 0 ? 0.0 : random.uniform(0.5, 2.0), random.uniform(0.5, 1.0),
               random.uniform(-0.1, 0.1), random.uniform(-1.0, 0.0), random.uniform(-0.1, 0.1));
    }
  }
  std::vector<std::pair<Index, Index>> pairs;
  for (std::size_t column = 0; column < ids.size(); ++column) {
    const std::vector<Index>&here = ids[column], &right = ids[(column + 1) % ids.size()];
    for (std::size_t k = 1; k < here.size(); ++k) {
      pairs.emplace_back(here[k - 1], here[k]);
      if (k > 1) pairs.emplace_back(here[k - 2], here[k]);
      pairs.emplace_back(std::minmax(here[k], right[k]));
      if (k + 1 < here.size() && random.uniform() < 0.5)
        pairs.emplace_back(std::minmax(here[k], right[k + 1]));
    }
  }
  std::ranges::sort(pairs);
  for (const auto& [a, b] : pairs) {
    const double angle = random.uniform(0.25, 0.75) * pi;  // upwards from the lower one
    add_contact(problem, a, b, std::cos(angle), std::sin(angle), 0.5, random.uniform(0.0, 0.01));
  }
  return problem;
}

solver::ContactSolution no_guess(const solver::ContactProblem& problem) {
  solver::ContactSolution solution;
  solution.pn.assign(static_cast<std::size_t>(problem.contact_count()), 0.0);
  solution.pt = solution.pn;
  if (problem.resists_rolling()) solution.pr = solution.pn;
  return solution;
}

solver::SolverSettings solver_settings(solver::SolverKind kind, double tolerance, int max_iterations) {
  solver::SolverSettings settings;
  settings.kind = kind;
  settings.tolerance = tolerance;
  settings.max_iterations = max_iterations;
  return settings;
}

solver::SolverReport solve_to(solver::SolverKind kind, const solver::ContactProblem& problem,
                              solver::ContactSolution& solution, double tolerance, int max_iterations) {
  solver::SolverWorkspace workspace;
  return solve(problem, solver_settings(kind, tolerance, max_iterations), workspace, solution);
}

double difference(const solver::ContactProblem& problem, const solver::ContactSolution& one,
                  const solver::ContactSolution& other) {
  double largest = 0.0;
  for (Index i = 0; i < problem.body_count(); ++i)
    largest = std::max({largest, std::fabs(one.vx[i] - other.vx[i]), std::fabs(one.vy[i] - other.vy[i]),
                        problem.lever[i] * std::fabs(one.omega[i] - other.omega[i])});
  return largest;
}

}  // namespace talus::test
