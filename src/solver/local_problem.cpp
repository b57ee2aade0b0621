#include "solver/local_problem.h"

#include <algorithm>
#include <cmath>

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
  std::vector<std::vector<Index>> contacts(problem.body_count());
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
    local.row_begin.push_back(local.column.size());
    while (next < entries.size() && entries[next].row / 2 == c) {
      const Index column = entries[next].column / 2;
      DelassusBlock block;
      for (; next < entries.size() && entries[next].row / 2 == c && entries[next].column / 2 == column;
           ++next)
        add(block, entries[next]);
      append_block(local, c, column, block);
    }
  }
  local.row_begin.push_back(local.column.size());
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
    local.row_begin.push_back(local.column.size());
    row = {c};
    for (const Index body : {problem.a[c], problem.b[c]})
      row.insert(row.end(), contacts[body].begin(), contacts[body].end());
    std::ranges::sort(row);
    row.erase(std::unique(row.begin(), row.end()), row.end());
    for (const Index d : row) append_block(local, c, d, delassus_block(problem, c, d));
  }
  local.row_begin.push_back(local.column.size());
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
