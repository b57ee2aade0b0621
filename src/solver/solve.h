#pragma once
/// The solver room finds the impulses of one step. A ContactProblem (problem.h) knows neither grains nor
/// geometry; a solution satisfies the contact law of every contact to a residual (T14). Read
/// gauss_seidel_sweep below for the method, AcceleratedWorkspace for the solver that runs use, and
/// docs/solver.md.
///
/// One call for all solvers.

#include <exception>
#include <memory>

#include "base/thread_team.h"
#include "solver/linearisation.h"
#include "solver/problem.h"

namespace talus::solver {

// The choice between a team of threads and a single thread.

/// Decides whether a team or a single thread is faster at present, from the measured cost of work in both. If
/// other processes need the processors, the members of a team wait for each other more than they help. Starts
/// with the team. Results must not depend on the choice.
class TeamChoice {
 public:
  /// Whether the next work should be done by the team.
  bool in_team() const { return in_team_; }

  /// Records the wall time, s, of work that was done as in_team() said, and its amount in any unit
  /// proportional to time.
  void add(double seconds, double work);

 private:
  void decide(double cost);
  void turn() { in_team_ = !in_team_; }

  bool in_team_ = true;
  bool on_trial_ = false;
  double seconds_ = 0.0, work_ = 0.0;  ///< time and work of the present window
  double usual_cost_ = 0.0;            ///< s per unit of work in recent windows, trials excluded
  double min_alone_ = 0.0;             ///< smallest cost of a single thread; 0: never tried
  int windows_since_trial_ = 0;        ///< windows since the last trial
  int trial_interval_ = 0;             ///< windows between two trials
};

// The accelerated solver: Gauss-Seidel sweeps with Nesterov's momentum (T16). Contacts are swept in groups
// that share no body, so that a sweep vectorises and gives the same bits on any number of threads.

/// Arrays and threads kept between solves. No result depends on them.
struct AcceleratedWorkspace {
  Linearisation linearisation;
  std::vector<SweepSums> sums;  ///< sums_of_part entries for each part of a sweep
  ContactSolution mean;         ///< mean of the last values of P0, without velocities
  std::unique_ptr<ThreadTeam> team;
  TeamChoice choice;           ///< choice between the team and its first member alone
  std::exception_ptr failure;  ///< exception of a member, rethrown by the caller of the team
};

struct AcceleratedOutcome {
  int iterations = 0;  ///< iterations over all contacts
  Residual residual;
};

/// Returns the team that would solve this problem at present; null if one thread would.
ThreadTeam* solver_team(const ContactProblem& problem, int threads, AcceleratedWorkspace& workspace);

/// Solves until the natural-map residual is at most `tolerance` or `max_iterations` have been made. Contacts
/// must be sorted by their first body. `solution` is as in solve(), and `threads` >= 1.
AcceleratedOutcome solve_accelerated(const ContactProblem& problem, double tolerance, int max_iterations,
                                     int threads, AcceleratedWorkspace& workspace, ContactSolution& solution);

// The reference solver: nonlinear Gauss-Seidel (T15), plain and readable. Tests compare others with it.

/// Makes one sweep over all contacts in their order. Each contact is solved exactly for the current
/// velocities, and then its rolling impulse, if it has one. `solution` holds impulses and the velocities that
/// belong to them, before and after.
void gauss_seidel_sweep(const ContactProblem& problem, ContactSolution& solution);

enum class SolverKind {
  gauss_seidel,  ///< reference: nonlinear Gauss-Seidel in the order of the contacts
  accelerated,   ///< the same with Nesterov's momentum, vectorised and threaded
};

struct SolverSettings {
  SolverKind kind = SolverKind::accelerated;
  double tolerance = 1e-6;    ///< natural-map residual eta to reach
  int max_iterations = 5000;  ///< limit of iterations over all contacts
  int threads = 1;            ///< threads of the accelerated solver; the result does not depend on them
};

/// Outcome of a solve. A missed tolerance is a result, not an error.
struct SolverReport {
  int iterations = 0;  ///< iterations over all contacts
  Residual residual;
  bool converged = false;
};

/// Memory that a solver keeps between steps so that a steady step allocates nothing. The result of a solve
/// does not depend on earlier solves.
struct SolverWorkspace {
  AcceleratedWorkspace accelerated;
};

/// Returns the team that would solve this problem at present; null if one thread would, or if the solver has
/// no team.
ThreadTeam* solver_team(const ContactProblem& problem, const SolverSettings& settings,
                        SolverWorkspace& workspace);

/// Solves the problem, (T7) with (T9) and (T10), from the first guess in `solution` to the tolerance, and
/// judges the result by natural_map_residual. The same problem and guess give the same bits.
SolverReport solve(const ContactProblem& problem, const SolverSettings& settings, SolverWorkspace& workspace,
                   ContactSolution& solution);

}  // namespace talus::solver
