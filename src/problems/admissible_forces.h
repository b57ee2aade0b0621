#pragma once
/// Admissible forces of a bed whose grains are held in place. A frictional packing with more contacts than
/// balance needs has many admissible sets of forces. They are searched for from many first guesses, and the
/// quantities measured with each set are compared (docs/studies/admissible-forces.md).

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/parameters.h"
#include "core/bed_frame.h"
#include "core/random.h"
#include "problems/step_problem.h"

namespace talus::problems {

/// First guess of a search. Random forces act on closed contacts only; the mean of their normal forces is
/// that of the remembered ones times a random number between 0 and 2, and |f_t| is uniform up to mu f_n.
enum class ForceStart {
  stored,       ///< forces remembered by the bed
  zero,         ///< no forces
  halved,       ///< half of the remembered forces
  doubled,      ///< twice the remembered forces
  scattered,    ///< remembered forces, each contact times a random factor, uniform between 0 and 2
  exponential,  ///< f_n exponentially distributed
  uniform,      ///< f_n uniform between zero and twice the mean
};

/// Method of a search.
enum class ForceMethod {
  balance,           ///< finds forces near the start that hold all grains (solver/balance.h)
  contact_dynamics,  ///< accelerated solver of the runs, as in a step without memory
  shuffled_sweeps,   ///< nonlinear Gauss-Seidel with the contacts in a random order
};

/// Start and method of a search for a set of forces.
struct ForceAttempt {
  ForceStart start = ForceStart::stored;
  ForceMethod method = ForceMethod::balance;
};

/// Returns a name such as "zero" or "zero, shuffled sweeps".
std::string name_of(const ForceAttempt& attempt);

struct ForceSearch {
  int solutions = 20;       ///< number of attempts in addition to that from the stored forces
  double tolerance = 3e-7;  ///< residual eta to reach
  int max_iterations = 20000;
  std::uint64_t seed = 1;  ///< seed of the random starts and orders
};

/// Returns the attempts of a search in their order: first from the stored forces, by contact dynamics, and
/// then `solutions` others: zero, halved and doubled by balance, zero by the two other methods, and random
/// starts of the three kinds in turn, by balance.
std::vector<ForceAttempt> force_attempts(const ForceSearch& search);

/// Returns the first guess of an attempt, impulses in the order of the contacts of the bed.
solver::ContactSolution first_guess(ForceStart start, const FrozenBed& bed, Random& random);

/// Forces found by an attempt.
struct ForceSet {
  ForceAttempt attempt;
  solver::SolverReport report;
  solver::ContactSolution solution;  ///< impulses and velocities of the step
  double momentum_left = 0.0;  ///< rms velocity after the step, over g h: 0 if all grains are balanced, 1 if
                               ///< all fall
  Index unbalanced = 0;        ///< number of free grains with a velocity above 0.1 g h
  double distance = 0.0;       ///< || P - P_stored || / || P_stored || over all contacts
  std::vector<double> values;  ///< values of the quantities

  /// Whether the method has converged and these forces hold the bed at rest by the criterion of a run.
  bool admissible() const { return report.converged && momentum_left <= at_rest; }
  static constexpr double at_rest = 0.005;  ///< rms velocity over g h
};
ForceSet find_forces(const FrozenBed& bed, const ForceAttempt& attempt, const ForceSearch& search,
                     Random& random);

/// Returns the bed with these forces and the velocities of the step.
World loaded_world(const FrozenBed& bed, const solver::ContactSolution& solution);

/// Quantity measured with a set of forces.
struct ForceQuantity {
  std::string name;     ///< Gamma, critical_share, p_o, lc_mean, lc_max; lengths in D
  double factor = 0.0;  ///< threshold over Gamma_c; 0 for a quantity without a threshold
};

/// Statistics of a quantity over the admissible sets, except that from the stored forces.
struct ForceSpread {
  int count = 0;
  double mean = 0.0;       ///< NaN for count 0
  double deviation = 0.0;  ///< standard deviation, with n - 1; NaN for count < 2
  double least = 0.0, largest = 0.0;
};

/// A frame and its admissible forces. `stored`, the values of each set and `spreads` are in the order of
/// `quantities`.
struct FrameForces {
  double tilt = 0.0;   ///< rad
  Index contacts = 0;  ///< number of contacts of the problem, including near contacts
  std::vector<ForceQuantity> quantities;
  std::vector<double> stored;  ///< values with the forces stored by the run, as in `talus analyze`
  std::vector<ForceSet> sets;  ///< sets that were found; the first is from the stored forces
  std::vector<ForceSpread> spreads;

  int admissible() const;  ///< number of admissible sets, without the first
};

/// Searches for the forces of a frozen bed and measures each set with the functions of an ordinary analysis.
/// `stored` is the frame with its stored forces; `theta_c` in rad gives Gamma_c if the parameters do not.
/// Throws Error(bad_data) if neither does, or if the parameters average over frames.
FrameForces admissible_forces(const FrozenBed& bed, const BedFrame& stored,
                              const analysis::AnalysisParameters& parameters, double theta_c,
                              const ForceSearch& search);

/// Does the same for frame k of a run.
FrameForces admissible_forces(const io::RunFile& run, std::size_t k,
                              const analysis::AnalysisParameters& parameters, const ForceSearch& search);

}  // namespace talus::problems
