#include "solver/accelerated.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "solver/momentum.h"

namespace talus {
namespace {

// P0 is renewed after so many sweeps at the latest, as velocities in single precision gather their rounding
// errors sweep by sweep; without a guess sooner at first, as || P || grows from nothing.
constexpr int sweeps_to_renewal = 128;
constexpr int first_renewal_cold = 16;
// The residual is looked at when its estimate is so many times the tolerance; when that was too early, the
// next time is judged by how the two compared. A little below the tolerance, so that the next steps of a
// quiet bed find it solved.
constexpr double hopeful = 1.1;
constexpr double cautious = 0.85;
// With a guess, what is left is smooth: the momentum begins near its largest.
constexpr double first_theta_warm = 0.07;
// It begins anew at the first renewal after so many sweeps, as it would otherwise stay away for good once
// changes stay above the least one of all.
constexpr int sweeps_of_momentum = 256;

Momentum warm_momentum() {
  Momentum momentum;
  momentum.theta = first_theta_warm;
  return momentum;
}

SweepSums add_parts(const std::vector<SweepSums>& parts) {
  SweepSums sum;
  for (const SweepSums& part : parts) {
    sum.change += part.change;
    sum.ascent += part.ascent;
  }
  return sum;
}

/// What one member of the team works on, and all members together wait for.
struct TeamMember {
  const ContactProblem& problem;
  ContactSolution& solution;
  AcceleratedWorkspace& w;
  Linearisation& at;
  ThreadTeam* team;  ///< null: alone
  int member, size;
  SweepKernels kernels;
  Index first_block, last_block, first_body, last_body, first_row = 0, last_row = 0;

  TeamMember(const ContactProblem& of, ContactSolution& of_solution, AcceleratedWorkspace& workspace,
             ThreadTeam* of_team, int of_member)
      : problem(of),
        solution(of_solution),
        w(workspace),
        at(workspace.linearisation),
        team(of_team),
        member(of_member),
        size(of_team ? of_team->size() : 1),
        kernels(sweep_kernels()) {
    const auto blocks = static_cast<int>(at.sums.size());
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
    load_contacts(problem, solution, first_block, last_block, at);
    wait_for_all();
    if (member == 0) at.are_loaded = true;
    return look();
  }

  ExactResidual look() {
    sum_exact_velocities(problem, first_body, last_body, at);
    wait_for_all();
    look_at_contacts(problem, kernels, first_block, last_block, at);
    wait_for_all();
    return exact_residual(at);
  }

  /// False where memory is missing: all members see it, and return.
  bool begin_sweeps() {
    choose_swept(problem, first_block, last_block, at);
    return load_sweeps();
  }

  bool sweep_more() {
    add_pressed(problem, first_block, last_block, at);
    return load_sweeps();
  }

  bool load_sweeps() {
    wait_for_all();
    // The others wait: an exception that passed them by would leave them waiting for ever.
    if (member == 0) try {
        order_contacts(problem, at);
        w.sums.assign(static_cast<std::size_t>(at.order.part_count()), {});
      } catch (...) {
        at.ordered_swept.clear();  // its groups are not loaded
        w.failure = std::current_exception();
      }
    wait_for_all();
    if (w.failure) return false;
    first_row = part_begin(at.order.row_count, member, size);
    last_row = part_begin(at.order.row_count, member + 1, size);
    clear_rows(first_row, last_row, at);
    load_groups(problem, first_block, last_block, at);
    wait_for_all();
    return true;
  }

  /// P0 becomes the present P; returns its residual.
  ExactResidual renew() {
    absorb_increments(problem, first_block, last_block, at);
    absorb_velocities(first_row, last_row, at);
    wait_for_all();
    return look();
  }

  void go_on() {
    linearise_groups(problem, first_block, last_block, at);
    wait_for_all();
  }

  /// The solution becomes P0.
  void unload() {
    unload_impulses(problem, first_block, last_block, at, solution);
    unload_velocities(problem, first_body, last_body, at, solution);
  }

  SweepSums sweep(const Momentum& momentum) {
    const auto beta = static_cast<float>(momentum.beta);
    const SweepOrder& order = at.order;
    const ContactArrays arrays = contact_arrays(at);
    const ContactKernel sweep_groups =
        problem.resists_rolling() ? kernels.rolling_contacts : kernels.contacts;
    kernels.bodies(body_arrays(at), first_row, last_row, beta);
    wait_for_all();
    for (int phase = 0; phase < SweepOrder::phases; ++phase) {
      const Index first = order.phase_begin[phase], parts = order.phase_begin[phase + 1] - first;
      if (order.part_begin[first] == order.part_begin[first + parts]) continue;
      for (Index k = first + part_begin(parts, member, size); k < first + part_begin(parts, member + 1, size);
           ++k)
        sweep_groups(arrays, order.part_begin[k], order.part_begin[k + 1], beta, w.sums[k]);
      wait_for_all();
    }
    return add_parts(w.sums);
  }
};

/// The part of the work of one member of the team. Each keeps a momentum of its own, and all come to the same
/// decisions and return the same outcome. || p_new - y || / || P || of a sweep stands in for the residual
/// between renewals: it costs nothing, and tells when a look at the residual itself is worth its price. Only
/// that decides.
AcceleratedOutcome solve_part(TeamMember& member, double tolerance, int max_iterations) {
  AcceleratedOutcome outcome;
  ExactResidual at = member.begin();
  outcome.residual = at.residual;
  if (at.residual.eta <= tolerance || max_iterations <= 0) return outcome;
  Momentum momentum = at.cold ? Momentum{} : warm_momentum();
  int next_momentum = sweeps_of_momentum;
  double aim = hopeful * tolerance;
  int interval = at.cold ? first_renewal_cold : sweeps_to_renewal;
  if (!member.begin_sweeps()) return outcome;
  for (;;) {
    double estimate = 0.0;
    const int renewal = std::min(max_iterations, outcome.iterations + interval);
    do {
      const SweepSums sums = member.sweep(momentum);
      ++outcome.iterations;
      const double change = std::sqrt(sums.change);
      estimate = change / at.norm;
      momentum.update(change, sums.ascent);
    } while (estimate > aim && outcome.iterations < renewal);
    at = member.renew();
    outcome.residual = at.residual;
    if (at.residual.eta <= tolerance || outcome.iterations >= max_iterations) return outcome;
    if (estimate > aim)
      interval = std::min(2 * interval, sweeps_to_renewal);
    else if (at.pressed == 0)
      aim = cautious * tolerance * std::min(hopeful, estimate / at.residual.eta);
    if (at.pressed > 0) {
      if (!member.sweep_more()) return outcome;
      momentum = {};
    } else {
      member.go_on();
      if (outcome.iterations >= next_momentum) momentum = warm_momentum();
    }
    if (outcome.iterations >= next_momentum) next_momentum = outcome.iterations + sweeps_of_momentum;
  }
}

/// The team for a problem, of no more threads than find work; null where that is one. What has been learnt of
/// teams stays: while a bed is poured, the number of those who find work goes up and down.
ThreadTeam* team_for(const ContactProblem& problem, AcceleratedWorkspace& w, int threads) {
  const int useful = std::clamp(most_members(problem), 1, threads);
  if (useful == 1) return nullptr;  // a team that is there may be wanted again by the next solve
  if (!w.team || w.team->size() != useful) w.team = std::make_unique<ThreadTeam>(useful);
  return w.team.get();
}

/// What a solve costs beside its iterations, in iterations: some 35 ns for each contact, to 2 ns of an
/// iteration.
constexpr int iterations_for_the_rest = 17;

}  // namespace

AcceleratedOutcome solve_accelerated(const ContactProblem& problem, double tolerance, int max_iterations,
                                     int threads, AcceleratedWorkspace& workspace,
                                     ContactSolution& solution) {
  prepare(problem, solution, workspace.linearisation);
  for (auto* field : {&solution.vx, &solution.vy, &solution.omega})
    field->resize(static_cast<std::size_t>(problem.body_count()));
  const auto begin = std::chrono::steady_clock::now();
  AcceleratedOutcome outcome;
  const auto take_part = [&](ThreadTeam* team, int member) {
    TeamMember part(problem, solution, workspace, team, member);
    const AcceleratedOutcome mine = solve_part(part, tolerance, max_iterations);
    part.unload();
    if (member == 0) outcome = mine;
  };
  ThreadTeam* const team = team_for(problem, workspace, threads);
  if (team != nullptr && workspace.choice.in_team())
    team->run([&](int member) { take_part(team, member); });
  else
    take_part(nullptr, 0);
  if (workspace.failure) std::rethrow_exception(std::exchange(workspace.failure, nullptr));
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  if (team != nullptr)
    workspace.choice.add(taken.count(), static_cast<double>(problem.contact_count()) *
                                            (outcome.iterations + iterations_for_the_rest));
  return outcome;
}

}  // namespace talus
