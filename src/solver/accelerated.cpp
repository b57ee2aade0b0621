#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "solver/solve.h"
#include "solver/sweep.h"

namespace talus::solver {

namespace {

constexpr double window = 0.02;  // s, several slices of the scheduler
// Windows between two trials: few if the last trial paid, and doubled after each trial that did not.
constexpr int min_trial_interval = 8;
constexpr int max_trial_interval = 256;
// Length (s) of a trial that seems to pay, because a team may have all processors for one window by chance.
constexpr double trial = 4.0 * window;
// Weight of a window in the usual cost. It is small because a single window may be slow by chance, and a
// trial would then seem to pay.
constexpr double share_of_window = 0.25;

}  // namespace

void TeamChoice::add(double seconds, double work) {
  seconds_ += seconds;
  work_ += work;
  if (seconds_ < window || work_ <= 0.0) return;
  const double cost = seconds_ / work_;
  if (on_trial_ && cost < usual_cost_ && seconds_ < trial) return;
  decide(cost);
  seconds_ = work_ = 0.0;
}

void TeamChoice::decide(double cost) {
  if (!in_team_) min_alone_ = min_alone_ == 0.0 ? cost : std::min(min_alone_, cost);
  if (on_trial_) {
    on_trial_ = false;
    windows_since_trial_ = 0;
    const bool pays = cost < usual_cost_;
    if (pays) usual_cost_ = cost;
    trial_interval_ =
        pays ? min_trial_interval : std::clamp(2 * trial_interval_, min_trial_interval, max_trial_interval);
    if (!pays) turn();
    return;
  }
  usual_cost_ = usual_cost_ == 0.0 ? cost : (1.0 - share_of_window) * usual_cost_ + share_of_window * cost;
  // A team faster than the fastest window of a single thread needs no trial.
  if (++windows_since_trial_ <= trial_interval_ || (in_team_ && min_alone_ > 0.0 && cost < min_alone_))
    return;
  on_trial_ = true;
  turn();
}

namespace {

// P0 is renewed at least after this many sweeps, because the velocities in single precision accumulate
// rounding errors. Without a guess it is renewed sooner at first, because || P || grows from zero.
constexpr int sweeps_to_renewal = 128;
constexpr int first_renewal_cold = 16;
// The residual is computed when its estimate falls below `target_fraction` times the tolerance. If that is
// too early, the ratio of the two and the factor `cautious` set the estimate at which it is computed next. If
// the guess is within `near_solution` tolerances of a solution, the bed is quiet, and the solve aims at
// `ahead` times the tolerance, so that the next steps are often solved already.
constexpr double target_fraction = 1.1;
constexpr double cautious = 0.85;
constexpr double near_solution = 10.0;
constexpr double ahead = 0.8;
// With a guess, the remaining error is smooth, so the momentum starts near its largest value.
constexpr double first_theta_warm = 0.1;
// The momentum also restarts with this theta at the first renewal after this many sweeps, and each time that
// their number has doubled. More frequent restarts would not give it the time that a tall column needs.
constexpr int sweeps_of_momentum = 128;
// In some steps, mostly when grains hit the bed, a few contacts alternate between opening and sliding in a
// limit cycle. The mean over a cycle is near a solution. After `sweeps_to_means` sweeps, P0 is therefore
// renewed more often, and is replaced by the mean of its last values if that has the smaller residual.
constexpr int sweeps_to_means = 512;
constexpr int sweeps_between_averaged = 16;
constexpr int averaged_values = 4;

Momentum warm_momentum() {
  Momentum momentum;
  momentum.theta = first_theta_warm;
  return momentum;
}

/// The work of one member of the team in a solve.
struct TeamMember {
  const ContactProblem& problem;
  ContactSolution& solution;
  AcceleratedWorkspace& w;
  Linearisation& at;
  ThreadTeam* team;  ///< null: single thread
  int member, size;
  Index first_block, last_block, first_body, last_body;
  Sweeper sweeper;

  TeamMember(const ContactProblem& contact_problem, ContactSolution& contact_solution,
             AcceleratedWorkspace& workspace, ThreadTeam* thread_team, int number)
      : problem(contact_problem),
        solution(contact_solution),
        w(workspace),
        at(workspace.linearisation),
        team(thread_team),
        member(number),
        size(thread_team ? thread_team->size() : 1),
        sweeper{at, w.sums, team, member, size, sweep_kernels()} {
    const auto blocks = static_cast<int>(at.sums.size());
    first_block = part_begin(blocks, member, size);
    last_block = part_begin(blocks, member + 1, size);
    first_body = part_begin(problem.body_count(), member, size);
    last_body = part_begin(problem.body_count(), member + 1, size);
  }

  Index first_own_row() const { return part_begin(at.order.row_count, member, size); }
  Index last_own_row() const { return part_begin(at.order.row_count, member + 1, size); }

  void wait_for_all() const {
    if (team) team->wait_for_all();
  }

  /// Sets P0 to the guess; returns its residual.
  ExactResidual begin() {
    const ExactResidual guess_residual = set_impulses(solution);
    if (member == 0) at.are_loaded = true;
    return guess_residual;
  }

  /// Sets P0 to these impulses; returns their residual.
  ExactResidual set_impulses(const ContactSolution& impulses) {
    load_contacts(problem, impulses, first_block, last_block, at);
    wait_for_all();
    return compute_residual();
  }

  ExactResidual compute_residual() {
    sum_exact_velocities(problem, sweeper.kernels, first_body, last_body, at);
    wait_for_all();
    linearise_contacts(problem, sweeper.kernels, first_block, last_block, at);
    wait_for_all();
    return exact_residual(at);
  }

  /// Chooses and loads the contacts to sweep. Returns false if memory is missing; all members then return.
  bool begin_sweeps() {
    choose_swept(problem, first_block, last_block, at);
    return load_sweeps();
  }

  /// Lets the first member do work that allocates, while the others wait. Its exceptions are stored, because
  /// the others would otherwise wait for ever. Returns false if it failed.
  template <typename Do>
  bool on_first_member(const Do& what) {
    if (member == 0) try {
        what();
      } catch (...) {
        at.ordered_swept.clear();  // its groups are not loaded
        w.failure = std::current_exception();
      }
    wait_for_all();
    return !w.failure;
  }

  /// Orders the contacts to be swept. Returns false if memory is missing.
  bool order_contacts() {
    find_parts(problem, at.moves, at.swept, member, size, at.order);
    wait_for_all();
    if (!on_first_member([this] { open_order(problem, at.moves, at.swept, at.order); })) return false;
    order_parts(problem, at.moves, at.swept, member, size, at.order);
    wait_for_all();
    return on_first_member([this] {
      end_order_of_contacts(problem, at);
      w.sums.assign(sums_of_part * static_cast<std::size_t>(at.order.part_count()), {});
    });
  }

  bool sweep_more() {
    add_pressed(problem, first_block, last_block, at);
    return load_sweeps();
  }

  bool load_sweeps() {
    wait_for_all();
    if (!on_first_member([this] { begin_order_of_contacts(problem, size, at); })) return false;
    if (at.have_new_order && !order_contacts()) return false;
    clear_rows(first_own_row(), last_own_row(), at);
    load_groups(problem, first_block, last_block, at);
    wait_for_all();
    return true;
  }

  /// Sets P0 to the present P; returns its residual.
  ExactResidual renew() {
    absorb_increments(problem, first_block, last_block, at);
    absorb_velocities(first_own_row(), last_own_row(), at);
    wait_for_all();
    return compute_residual();
  }

  void average(int count) { average_impulses(problem, first_block, last_block, at, count, w.mean); }

  /// Replaces P0 by the mean of its last values if that has a smaller residual than `now`, and updates `now`.
  /// Returns whether P0 was replaced.
  bool take_mean(ExactResidual& now) {
    unload_impulses(problem, first_block, last_block, at, solution);
    const ExactResidual mean_residual = set_impulses(w.mean);
    const bool is_better = mean_residual.residual.eta < now.residual.eta;
    now = is_better ? mean_residual : set_impulses(solution);
    return is_better;
  }

  void relinearise() {
    linearise_groups(problem, first_block, last_block, at);
    wait_for_all();
  }

  /// Copies P0 and its velocities to the solution.
  void unload() {
    unload_impulses(problem, first_block, last_block, at, solution);
    unload_velocities(problem, first_body, last_body, at, solution);
  }
};

/// Does the work of one member of the team. Each member keeps its own momentum; all make the same decisions
/// and return the same outcome. Between renewals || p_new - y || / || P || of a sweep, which costs nothing,
/// estimates the residual and shows when to compute it. Only the residual itself ends a solve.
AcceleratedOutcome solve_part(TeamMember& member, double tolerance, int max_iterations) {
  AcceleratedOutcome outcome;
  ExactResidual at = member.begin();
  outcome.residual = at.residual;
  if (at.residual.eta <= tolerance || max_iterations <= 0) return outcome;
  Momentum momentum = at.cold ? Momentum{} : warm_momentum();
  int next_momentum = sweeps_of_momentum;
  const double share = at.residual.eta < near_solution * tolerance ? ahead : 1.0;
  double aim = share * target_fraction * tolerance;
  int interval = at.cold ? first_renewal_cold : sweeps_to_renewal;
  int averaged = 0;
  if (!member.begin_sweeps()) return outcome;
  for (;;) {
    double estimate = 0.0;
    const int renewal = std::min(max_iterations, outcome.iterations + interval);
    do {
      const int count = std::min(sweeps_in_a_row(member.at.order), renewal - outcome.iterations);
      estimate = sweep(member.sweeper, count, momentum) / at.norm;
      outcome.iterations += count;
    } while (estimate > aim && outcome.iterations < renewal);
    at = member.renew();
    if (estimate > aim)
      interval = std::min(2 * interval, sweeps_to_renewal);
    else if (at.pressed == 0)
      aim = share * cautious * tolerance * std::min(target_fraction, estimate / at.residual.eta);
    if (outcome.iterations >= next_momentum) {
      momentum = warm_momentum();
      next_momentum = 2 * outcome.iterations;
    }
    if (outcome.iterations >= sweeps_to_means) {
      interval = sweeps_between_averaged;
      member.average(++averaged);
      if (averaged == averaged_values) {
        averaged = 0;
        if (at.residual.eta > tolerance && member.take_mean(at)) momentum = warm_momentum();
      }
    }
    outcome.residual = at.residual;
    if (at.residual.eta <= tolerance || outcome.iterations >= max_iterations) return outcome;
    if (at.pressed > 0) {
      if (!member.sweep_more()) return outcome;
      momentum = {};
    } else {
      member.relinearise();
    }
  }
}

/// Returns the team for a problem, with at most as many threads as it can use; null if that is one. The
/// measured costs of teams are kept, because the number of useful threads rises and falls while a bed is
/// poured.
ThreadTeam* team_for(const ContactProblem& problem, AcceleratedWorkspace& w, int threads) {
  const int useful = std::clamp(max_members(problem), 1, threads);
  if (useful == 1) return nullptr;  // an existing team is kept for later solves
  if (!w.team || w.team->size() != useful) w.team = std::make_unique<ThreadTeam>(useful);
  return w.team.get();
}

/// Cost of a solve apart from its iterations, in iterations: about 35 ns per contact, compared with 2 ns for
/// an iteration.
constexpr int iterations_for_the_rest = 17;

}  // namespace

ThreadTeam* solver_team(const ContactProblem& problem, int threads, AcceleratedWorkspace& workspace) {
  ThreadTeam* const team = team_for(problem, workspace, threads);
  return team != nullptr && workspace.choice.in_team() ? team : nullptr;
}

AcceleratedOutcome solve_accelerated(const ContactProblem& problem, double tolerance, int max_iterations,
                                     int threads, AcceleratedWorkspace& workspace,
                                     ContactSolution& solution) {
  ThreadTeam* const useful = team_for(problem, workspace, threads);
  ThreadTeam* const team = solver_team(problem, threads, workspace);
  prepare(problem, solution, team, workspace.linearisation);
  for (auto* field : {&solution.vx, &solution.vy, &solution.omega}) field->resize(problem.body_count());
  workspace.mean.pn.resize(solution.pn.size());
  workspace.mean.pt.resize(solution.pt.size());
  workspace.mean.pr.resize(solution.pr.size());
  const auto begin = std::chrono::steady_clock::now();
  AcceleratedOutcome outcome;
  auto take_part = [&](int member) {
    TeamMember part(problem, solution, workspace, team, member);
    const AcceleratedOutcome mine = solve_part(part, tolerance, max_iterations);
    part.unload();
    if (member == 0) outcome = mine;
  };
  if (team != nullptr)
    team->run(take_part);
  else
    take_part(0);
  if (workspace.failure) std::rethrow_exception(std::exchange(workspace.failure, nullptr));
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  if (useful != nullptr)
    workspace.choice.add(taken.count(), static_cast<double>(problem.contact_count()) *
                                            (outcome.iterations + iterations_for_the_rest));
  return outcome;
}

}  // namespace talus::solver
