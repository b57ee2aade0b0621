#include "solver/local_problem.h"

#include <algorithm>

namespace talus::solver {
namespace {

void add(DelassusBlock& block, const MatrixEntry& entry) {
  const bool tangential_row = entry.row % 2 == 1;
  const bool tangential_column = entry.column % 2 == 1;
  double& place =
      tangential_row ? (tangential_column ? block.tt : block.tn) : (tangential_column ? block.nt : block.nn);
  place += entry.value;
}

/// Adds to `block` the effect of an impulse of contact d on contact c through a body that they share. `sign`
/// is the product of the signs of the body in both contacts: -1 if it is the first body of one and the second
/// of the other.
void add_through_body(const ContactProblem& problem, Index c, Index d, Index body, double sign,
                      DelassusBlock& block) {
  const double mobility = sign * problem.inverse_mass[body];
  const double along = problem.nx[c] * problem.nx[d] + problem.ny[c] * problem.ny[d];
  const double across = problem.ny[c] * problem.nx[d] - problem.nx[c] * problem.ny[d];
  block.nn += mobility * along;
  block.nt += mobility * across;
  block.tn -= mobility * across;
  block.tt += mobility * along + spin_mobility(problem, body);
}

DelassusBlock delassus_block(const ContactProblem& problem, Index c, Index d) {
  DelassusBlock block;
  if (problem.a[c] == problem.a[d]) add_through_body(problem, c, d, problem.a[c], 1.0, block);
  if (problem.a[c] == problem.b[d]) add_through_body(problem, c, d, problem.a[c], -1.0, block);
  if (problem.b[c] == problem.a[d]) add_through_body(problem, c, d, problem.b[c], -1.0, block);
  if (problem.b[c] == problem.b[d]) add_through_body(problem, c, d, problem.b[c], 1.0, block);
  return block;
}

/// Lists the contacts of each body that can move. A body that cannot move does not couple its contacts.
std::vector<std::vector<Index>> contacts_of_bodies(const ContactProblem& problem) {
  std::vector<std::vector<Index>> contacts(static_cast<std::size_t>(problem.body_count()));
  for (Index c = 0; c < problem.contact_count(); ++c)
    for (const Index body : {problem.a[c], problem.b[c]})
      if (problem.inverse_mass[body] > 0.0 || problem.inverse_inertia[body] > 0.0)
        contacts[body].push_back(c);
  return contacts;
}

void append_block(LocalProblem& local, Index row, Index column, const DelassusBlock& block) {
  if (row == column) local.diagonal[row] = static_cast<Index>(local.column.size());
  local.column.push_back(column);
  local.block.push_back(block);
}

}  // namespace

LocalProblem local_problem(std::vector<MatrixEntry> entries, std::vector<RelativeVelocity> q,
                           std::vector<double> mu) {
  LocalProblem local;
  local.q = std::move(q);
  local.mu = std::move(mu);
  local.diagonal.resize(local.mu.size());
  const Index contacts = local.contact_count();
  for (Index c = 0; c < contacts; ++c)
    entries.push_back({2 * c, 2 * c, 0.0});  // ensures a diagonal block in each row
  std::ranges::stable_sort(
      entries, {}, [](const MatrixEntry& entry) { return std::pair(entry.row / 2, entry.column / 2); });
  std::size_t next = 0;
  for (Index c = 0; c < contacts; ++c) {
    local.row_begin.push_back(static_cast<Index>(local.column.size()));
    while (next < entries.size() && entries[next].row / 2 == c) {
      const Index column = entries[next].column / 2;
      DelassusBlock block;
      for (; next < entries.size() && entries[next].row / 2 == c && entries[next].column / 2 == column;
           ++next)
        add(block, entries[next]);
      append_block(local, c, column, block);
    }
  }
  local.row_begin.push_back(static_cast<Index>(local.column.size()));
  return local;
}

LocalProblem local_problem(const ContactProblem& problem) {
  const std::vector<std::vector<Index>> contacts = contacts_of_bodies(problem);
  LocalProblem local;
  local.mu = problem.mu;
  local.diagonal.resize(local.mu.size());
  std::vector<Index> row;
  for (Index c = 0; c < problem.contact_count(); ++c) {
    local.q.push_back(free_relative_velocity(problem, c));
    local.row_begin.push_back(static_cast<Index>(local.column.size()));
    row = {c};
    for (const Index body : {problem.a[c], problem.b[c]})
      row.insert(row.end(), contacts[body].begin(), contacts[body].end());
    std::ranges::sort(row);
    row.erase(std::unique(row.begin(), row.end()), row.end());
    for (const Index d : row) append_block(local, c, d, delassus_block(problem, c, d));
  }
  local.row_begin.push_back(static_cast<Index>(local.column.size()));
  return local;
}

LocalSolution local_form(const ContactProblem& problem, const ContactSolution& solution) {
  LocalSolution local;
  for (Index c = 0; c < problem.contact_count(); ++c) {
    local.p.push_back({solution.pn[c], solution.pt[c]});
    local.u.push_back(relative_velocity(problem, solution, c));
  }
  return local;
}

void velocities_from_impulses(const LocalProblem& problem, LocalSolution& solution) {
  solution.u.resize(solution.p.size());
  for (Index c = 0; c < problem.contact_count(); ++c)
    solution.u[c] = relative_velocity(problem, solution.p, c);
}

}  // namespace talus::solver
