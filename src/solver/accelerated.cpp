#include "solver/accelerated.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace talus {
namespace {

// Gradient steps in units of the inverse diagonal of W are stable below 2 / lambda_max(D^-1 W), with momentum
// below 4/3 / lambda_max; beds of disks have lambda_max near 3.45. The step shrinks where a problem asks for
// less.
constexpr double first_step = 0.44;
constexpr double smallest_step = 0.01;
// Sliding makes the problem non-associated: the residual can grow along the momentum. When it has grown by
// this much above the best since the last restart, the momentum is dropped.
constexpr double tolerated_growth = 1.3;
constexpr int patience = 10;
// The linearisation is renewed after so many iterations, then after twice as many each time: soon without a
// guess, as || P || grows from nothing.
constexpr int first_renewal_cold = 16;
constexpr int first_renewal_warm = 256;
// The residual is looked at when its estimate is so many times the tolerance; when that was too early, the
// next time is judged by how the two compared, with some caution.
constexpr double hopeful = 1.5;
constexpr double cautious = 0.9;

/// Decides after each iteration how to go on. Every thread keeps its own copy and comes to the same decision.
struct Momentum {
  double theta = 1.0;
  double beta = 0.0;
  double step = first_step;
  double best = 0.0;  ///< change per iteration, since the last restart
  int since_restart = 0;

  void restart() {
    theta = 1.0;
    beta = 0.0;
    since_restart = 0;
  }

  /// Nesterov's sequence with adaptive restart (T16). `change` is that of an iteration, in units of the step.
  void update(double change, double ascent) {
    if (since_restart == 0) best = change;
    best = std::min(best, change);
    const bool growing = change > tolerated_growth * best;
    if (growing && since_restart < patience && since_restart > 0) step = std::max(smallest_step, 0.8 * step);
    ++since_restart;
    if (ascent > 0.0 || growing) return restart();
    const double square = theta * theta;
    const double next = 0.5 * (std::sqrt(square * square + 4.0 * square) - square);
    beta = theta * (1.0 - theta) / (square + next);
    theta = next;
  }
};

IterationSums add_blocks(const std::vector<IterationSums>& blocks) {
  IterationSums sum;
  for (const IterationSums& block : blocks) {
    sum.change += block.change;
    sum.ascent += block.ascent;
  }
  return sum;
}

/// What one member of the team works on, and all members together wait for.
struct TeamMember {
  const ContactProblem& problem;
  AcceleratedWorkspace& w;
  ThreadTeam* team;  ///< null: alone
  GradientKernels kernels;
  Index first_block, last_block, first_body, last_body;

  TeamMember(const ContactProblem& of, AcceleratedWorkspace& workspace, ThreadTeam* of_team, int member)
      : problem(of), w(workspace), team(of_team), kernels(gradient_kernels()) {
    const auto blocks = static_cast<int>(w.sums.size());
    const int size = team ? team->size() : 1;
    first_block = part_begin(blocks, member, size);
    last_block = part_begin(blocks, member + 1, size);
    first_body = part_begin(problem.body_count(), member, size);
    last_body = part_begin(problem.body_count(), member + 1, size);
  }

  void wait_for_all() const {
    if (team) team->wait_for_all();
  }

  /// P0 becomes the guess; returns its residual.
  ExactResidual begin() {
    load_contacts(problem, first_block, last_block, w.linearisation);
    wait_for_all();
    return linearise();
  }

  /// P0 becomes the present P; returns its residual.
  ExactResidual renew() {
    absorb_increments(problem, first_block, last_block, w.linearisation);
    wait_for_all();
    return linearise();
  }

  /// Velocities due to y, after a renewal.
  void go_on() {
    kernels.bodies(body_arrays(w.linearisation), first_body, last_body);
    wait_for_all();
  }

  ExactResidual linearise() {
    sum_exact_velocities(problem, first_body, last_body, w.linearisation);
    wait_for_all();
    linearise_contacts(problem, first_block, last_block, w.linearisation);
    wait_for_all();
    return exact_residual(w.linearisation);
  }

  IterationSums iterate(const Momentum& momentum) {
    const auto groups = static_cast<Index>(w.linearisation.contacts.size());
    const ContactArrays arrays = contact_arrays(w.linearisation);
    for (Index block = first_block; block < last_block; ++block)
      kernels.contacts(arrays, block * groups_per_block, std::min(groups, (block + 1) * groups_per_block),
                       static_cast<float>(momentum.step), static_cast<float>(momentum.beta), w.sums[block]);
    wait_for_all();
    const IterationSums sums = add_blocks(w.sums);
    kernels.bodies(body_arrays(w.linearisation), first_body, last_body);
    wait_for_all();
    return sums;
  }
};

/// The part of the work of one member of the team; all members return the same outcome.
/// || p_new - y || / (step || P ||) stands in for the residual between renewals: it costs nothing, and tells
/// when a look at the residual itself is worth its price. Only that decides.
AcceleratedOutcome solve_part(TeamMember member, double tolerance, int max_iterations) {
  Momentum momentum;
  AcceleratedOutcome outcome;
  ExactResidual at = member.begin();
  double aim = hopeful * tolerance;
  int renewal = at.cold ? first_renewal_cold : first_renewal_warm;
  for (;;) {
    outcome.residual = at.residual;
    if (at.residual.eta <= tolerance || outcome.iterations >= max_iterations) return outcome;
    if (outcome.iterations > 0) member.go_on();
    double estimate = 0.0;
    do {
      const IterationSums sums = member.iterate(momentum);
      ++outcome.iterations;
      const double change = std::sqrt(sums.change) / momentum.step;
      estimate = change / at.norm;
      momentum.update(change, sums.ascent);
    } while (estimate > aim && outcome.iterations < std::min(max_iterations, renewal));
    at = member.renew();
    if (estimate <= aim)
      aim = cautious * tolerance * std::min(hopeful, estimate / at.residual.eta);
    else
      renewal *= 2;
  }
}

/// A thread is worth its waiting only with some work of its own.
constexpr int blocks_per_thread = 2;

void ensure_team(AcceleratedWorkspace& w, int threads) {
  const int useful = std::max(1, std::min(threads, static_cast<int>(w.sums.size()) / blocks_per_thread));
  if (w.team && w.team->size() == useful) return;
  w.team = std::make_unique<ThreadTeam>(useful);
  w.choice = {};
}

/// What a solve costs beside its iterations, in iterations: 0.5 ms to 0.043 ms for the paper's bed on one
/// core.
constexpr int iterations_for_the_rest = 11;

}  // namespace

AcceleratedOutcome solve_accelerated(const ContactProblem& problem, double tolerance, int max_iterations,
                                     int threads, AcceleratedWorkspace& workspace,
                                     ContactSolution& solution) {
  prepare(problem, solution, workspace.linearisation);
  workspace.sums.resize(workspace.linearisation.sums.size());
  ensure_team(workspace, threads);
  const auto begin = std::chrono::steady_clock::now();
  AcceleratedOutcome outcome;
  const auto take_part = [&](ThreadTeam* team, int member) {
    const AcceleratedOutcome mine = solve_part({problem, workspace, team, member}, tolerance, max_iterations);
    if (member == 0) outcome = mine;
  };
  ThreadTeam& team = *workspace.team;
  if (workspace.choice.in_team())
    team.run([&](int member) { take_part(&team, member); });
  else
    take_part(nullptr, 0);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  if (team.size() > 1)
    workspace.choice.add(taken.count(), static_cast<double>(problem.contact_count()) *
                                            (outcome.iterations + iterations_for_the_rest));
  unload_solution(problem, workspace.linearisation, solution);
  return outcome;
}

}  // namespace talus
