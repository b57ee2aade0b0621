#include "solver/accelerated.h"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

static_assert(contacts_per_block % lane_count == 0);

// Gradient steps in units of the inverse diagonal of W are stable below 2 / lambda_max(D^-1 W), with momentum
// below 4/3 / lambda_max; beds of disks have lambda_max near 3.45. The step shrinks where a problem asks for
// less.
constexpr double first_step = 0.33;
constexpr double smallest_step = 0.01;
// Sliding makes the problem non-associated: the residual can grow along the momentum. When it has grown by
// this much above the best since the last restart, the momentum is dropped.
constexpr double tolerated_growth = 1.3;
constexpr int patience = 10;

std::size_t padded(std::size_t contacts) { return (contacts + lane_count - 1) / lane_count * lane_count; }

void load_bodies(const ContactProblem& problem, AcceleratedWorkspace& w) {
  const auto bodies = static_cast<std::size_t>(problem.body_count());
  for (auto* field : {&w.free, &w.mobility, &w.now, &w.ahead}) field->resize(bodies);
  for (std::size_t i = 0; i < bodies; ++i) {
    const double lever = problem.lever[i];
    w.free[i] = Quad{problem.vx[i], problem.vy[i], lever * problem.omega[i], 0.0};
    w.mobility[i] = Quad{problem.inverse_mass[i], problem.inverse_mass[i],
                         lever * lever * problem.inverse_inertia[i], 0.0};
  }
}

/// Padding contacts lie between body 0 and itself and have no weight: they stay without impulse.
void load_contacts(const ContactProblem& problem, const ContactSolution& guess, AcceleratedWorkspace& w) {
  const auto contacts = static_cast<std::size_t>(problem.contact_count());
  const std::size_t size = padded(contacts);
  const auto copy = [&](const std::vector<double>& from, std::vector<double>& to) {
    to.resize(size);
    std::copy(from.begin(), from.end(), to.begin());
    std::fill(to.begin() + static_cast<std::ptrdiff_t>(contacts), to.end(), 0.0);
  };
  copy(problem.nx, w.nx);
  copy(problem.ny, w.ny);
  copy(problem.cn, w.cn);
  copy(problem.ct, w.ct);
  copy(problem.mu, w.mu);
  copy(guess.pn, w.pn);
  copy(guess.pt, w.pt);
  w.pn_before = w.pn;
  w.pt_before = w.pt;
  w.force.resize(size);
  w.a.assign(size, 0);
  w.b.assign(size, 0);
  w.wn.assign(size, 0.0);
  w.wt.assign(size, 0.0);
  for (std::size_t c = 0; c < contacts; ++c) {
    const Index a = w.a[c] = problem.a[c];
    const Index b = w.b[c] = problem.b[c];
    const double w_nn = w.mobility[a].x + w.mobility[b].x;
    if (!(w_nn > 0.0)) continue;  // two bodies that cannot move: whatever the impulse, nothing happens
    w.wn[c] = 1.0 / w_nn;
    w.wt[c] = 1.0 / (w_nn + w.mobility[a].spin + w.mobility[b].spin);
    w.force[c] =
        Quad{w.pn[c] * w.nx[c] - w.pt[c] * w.ny[c], w.pn[c] * w.ny[c] + w.pt[c] * w.nx[c], w.pt[c], 0.0};
  }
}

/// The contacts of each body: as a they are consecutive, as b they are listed.
void connect(const ContactProblem& problem, AcceleratedWorkspace& w) {
  const auto bodies = static_cast<std::size_t>(problem.body_count());
  w.first_a.assign(bodies + 1, 0);
  w.first_b.assign(bodies + 1, 0);
  w.b_contact.resize(problem.b.size());
  for (std::size_t c = 0; c < problem.a.size(); ++c) {
    ++w.first_a[problem.a[c] + 1];
    ++w.first_b[problem.b[c] + 1];
  }
  for (std::size_t i = 0; i < bodies; ++i) {
    w.first_a[i + 1] += w.first_a[i];
    w.first_b[i + 1] += w.first_b[i];
  }
  for (Index c = 0; c < problem.contact_count(); ++c) w.b_contact[w.first_b[problem.b[c]]++] = c;
  for (std::size_t i = bodies; i > 0; --i) w.first_b[i] = w.first_b[i - 1];
  w.first_b[0] = 0;
}

GradientArrays arrays_of(AcceleratedWorkspace& w) {
  GradientArrays arrays{};
  arrays.free = w.free.data();
  arrays.mobility = w.mobility.data();
  arrays.now = w.now.data();
  arrays.ahead = w.ahead.data();
  arrays.first_a = w.first_a.data();
  arrays.first_b = w.first_b.data();
  arrays.b_contact = w.b_contact.data();
  arrays.nx = w.nx.data();
  arrays.ny = w.ny.data();
  arrays.cn = w.cn.data();
  arrays.ct = w.ct.data();
  arrays.wn = w.wn.data();
  arrays.wt = w.wt.data();
  arrays.mu = w.mu.data();
  arrays.a = w.a.data();
  arrays.b = w.b.data();
  arrays.pn = w.pn.data();
  arrays.pt = w.pt.data();
  arrays.pn_before = w.pn_before.data();
  arrays.pt_before = w.pt_before.data();
  arrays.force = w.force.data();
  return arrays;
}

/// Decides after each pass how to go on. Every thread keeps its own copy and comes to the same decision.
struct Momentum {
  double theta = 1.0;
  double beta = 0.0;
  double step = first_step;
  double best = 0.0;  ///< residual, since the last restart
  int since_restart = 0;

  void restart() {
    theta = 1.0;
    beta = 0.0;
    since_restart = 0;
  }

  /// Nesterov's sequence with adaptive restart (O'Donoghue and Candes 2015).
  void update(double eta, double ascent) {
    if (since_restart == 0) best = eta;
    best = std::min(best, eta);
    const bool growing = eta > tolerated_growth * best;
    if (growing && since_restart < patience && since_restart > 0) step = std::max(smallest_step, 0.8 * step);
    ++since_restart;
    if (ascent > 0.0 || growing) return restart();
    const double square = theta * theta;
    const double next = 0.5 * (std::sqrt(square * square + 4.0 * square) - square);
    beta = theta * (1.0 - theta) / (square + next);
    theta = next;
  }
};

struct Outcome {
  int iterations = 0;
  const double *pn = nullptr, *pt = nullptr;  ///< the buffers that hold the solution
};

double residual(const PassSums& sums) {
  const double scale = sums.impulse > 0.0 ? sums.impulse : sums.impulse_after;
  return scale > 0.0 ? std::sqrt(sums.change / scale) : 0.0;
}

PassSums add_blocks(const std::vector<PassSums>& blocks) {
  PassSums sum;
  for (const PassSums& block : blocks) {
    sum.change += block.change;
    sum.impulse += block.impulse;
    sum.impulse_after += block.impulse_after;
    sum.ascent += block.ascent;
  }
  return sum;
}

/// The part of the work of one member of the team; all members return the same outcome.
Outcome iterate(AcceleratedWorkspace& w, const GradientKernels& kernels, double tolerance, int max_iterations,
                int member) {
  ThreadTeam& team = *w.team;
  GradientArrays arrays = arrays_of(w);
  const auto contacts = static_cast<Index>(w.pn.size());
  const auto bodies = static_cast<Index>(w.free.size());
  const auto blocks = static_cast<int>(w.sums.size());
  const int first_block = part_begin(blocks, member, team.size());
  const int last_block = part_begin(blocks, member + 1, team.size());
  const Index first_body = part_begin(bodies, member, team.size());
  const Index last_body = part_begin(bodies, member + 1, team.size());
  Momentum momentum;
  kernels.bodies(arrays, first_body, last_body, 0.0);
  team.wait_for_all();
  Outcome outcome;
  while (outcome.iterations < max_iterations) {
    arrays.beta = momentum.beta;
    arrays.step = momentum.step;
    for (int block = first_block; block < last_block; ++block)
      kernels.contacts(arrays, block * contacts_per_block,
                       std::min(contacts, (block + 1) * contacts_per_block), w.sums[block]);
    team.wait_for_all();
    ++outcome.iterations;
    const PassSums sums = add_blocks(w.sums);
    const double eta = residual(sums);
    // Without momentum y is P itself, and its residual is the one that counts: P is the solution, the new P
    // is not needed. With momentum a small residual at y calls for a look at P.
    if (eta <= tolerance && momentum.beta == 0.0) break;
    momentum.update(eta, sums.ascent);
    if (eta <= tolerance) momentum.restart();
    std::swap(arrays.pn, arrays.pn_before);
    std::swap(arrays.pt, arrays.pt_before);
    kernels.bodies(arrays, first_body, last_body, momentum.beta);
    team.wait_for_all();
  }
  outcome.pn = arrays.pn;
  outcome.pt = arrays.pt;
  return outcome;
}

/// A thread is worth its waiting only with some work of its own.
constexpr int blocks_per_thread = 2;

void ensure_team(AcceleratedWorkspace& w, int threads) {
  const int useful = std::max(1, std::min(threads, static_cast<int>(w.sums.size()) / blocks_per_thread));
  if (!w.team || w.team->size() != useful) w.team = std::make_unique<ThreadTeam>(useful);
}

}  // namespace

int solve_accelerated(const ContactProblem& problem, double tolerance, int max_iterations, int threads,
                      AcceleratedWorkspace& workspace, ContactSolution& solution) {
  AcceleratedWorkspace& w = workspace;
  if (problem.contact_count() == 0) {
    velocities_from_impulses(problem, solution);
    return 0;
  }
  load_bodies(problem, w);
  load_contacts(problem, solution, w);
  connect(problem, w);
  w.sums.assign((w.pn.size() + contacts_per_block - 1) / contacts_per_block, {});
  ensure_team(w, threads);
  const GradientKernels kernels = gradient_kernels();
  Outcome outcome;
  w.team->run([&](int member) {
    const Outcome mine = iterate(w, kernels, tolerance, max_iterations, member);
    if (member == 0) outcome = mine;
  });
  std::copy_n(outcome.pn, solution.pn.size(), solution.pn.begin());
  std::copy_n(outcome.pt, solution.pt.size(), solution.pt.begin());
  velocities_from_impulses(problem, solution);
  return outcome.iterations;
}

}  // namespace talus
