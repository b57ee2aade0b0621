#pragma once
/// Which forces can carry a bed whose grains are held where they are? A frictional packing with more contacts
/// than it needs has many admissible sets of them. Here they are looked for from many first guesses, and what
/// is measured of each set is compared (docs/admissible_forces.md).

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/parameters.h"
#include "core/bed_frame.h"
#include "core/random.h"
#include "problems/step_problem.h"

namespace talus::problems {

/// The forces from which a search starts. Random ones act on closed contacts only; the mean of their normal
/// forces is that of the remembered ones times a random number between 0 and 2, and |f_t| is uniform up to
/// mu f_n.
enum class ForceStart {
  stored,       ///< the memory of the bed itself
  zero,         ///< none
  halved,       ///< half of the memory
  doubled,      ///< twice the memory
  scattered,    ///< the memory, at each contact times a random factor, uniform between 0 and 2
  exponential,  ///< f_n exponentially distributed
  uniform,      ///< f_n uniform between zero and twice the mean
};

/// How a search goes on from there.
enum class ForceMethod {
  balance,           ///< to forces near the start that hold all grains (solver/balance.h)
  contact_dynamics,  ///< the accelerated solver of runs: what a step without memory would do
  shuffled_sweeps,   ///< nonlinear Gauss-Seidel, the contacts in a random order
};

/// One way to a set of forces.
struct ForceAttempt {
  ForceStart start = ForceStart::stored;
  ForceMethod method = ForceMethod::balance;
};

/// "zero", "zero, shuffled sweeps"
std::string name_of(const ForceAttempt& attempt);

struct ForceSearch {
  int solutions = 20;       ///< others than the one from the stored forces
  double tolerance = 3e-7;  ///< residual eta to reach
  int max_iterations = 20000;
  std::uint64_t seed = 1;  ///< of the random starts and orders
};

/// The attempts of a search in their order: first from the stored forces, by contact dynamics. Then
/// `solutions` others: zero, halved and doubled by balance, zero by the two other methods, and random starts
/// of the three kinds in turn, by balance.
std::vector<ForceAttempt> force_attempts(const ForceSearch& search);

/// The first guess of an attempt, impulses in the order of the contacts of the bed.
solver::ContactSolution first_guess(ForceStart start, const FrozenBed& bed, Random& random);

/// Forces that were found.
struct ForceSet {
  ForceAttempt attempt;
  solver::SolverReport report;
  solver::ContactSolution solution;  ///< impulses and velocities of the step
  double momentum_left = 0.0;  ///< rms velocity that the step gives, over g h: 0 where all is balanced, 1
                               ///< where all fall
  Index unbalanced = 0;        ///< free grains that get more than a tenth of g h
  double distance = 0.0;       ///< || P - P_stored || / || P_stored ||, of all contacts
  std::vector<double> values;  ///< of the quantities

  /// Whether these forces hold the bed as still as one is that a run takes to be at rest.
  bool admissible() const { return report.converged && momentum_left <= at_rest; }
  static constexpr double at_rest = 0.005;  ///< rms velocity over g h
};
ForceSet find_forces(const FrozenBed& bed, const ForceAttempt& attempt, const ForceSearch& search,
                     Random& random);

/// The bed with these forces, and the velocities of the step.
World loaded_world(const FrozenBed& bed, const solver::ContactSolution& solution);

/// What is measured of a set of forces.
struct ForceQuantity {
  std::string name;     ///< Gamma, critical_share, p_o, lc_mean, lc_max; lengths in D
  double factor = 0.0;  ///< of the threshold over Gamma_c; 0 where the quantity has none
};

/// A quantity over the admissible sets; the one from the stored forces does not count.
struct ForceSpread {
  int count = 0;
  double mean = 0.0;       ///< NaN for count 0
  double deviation = 0.0;  ///< s with n - 1; NaN for count < 2
  double least = 0.0, largest = 0.0;
};

/// One frame and its admissible forces. `stored`, the values of each set and `spreads` are in the order of
/// `quantities`.
struct FrameForces {
  double tilt = 0.0;   ///< rad
  Index contacts = 0;  ///< of the problem, near contacts among them
  std::vector<ForceQuantity> quantities;
  std::vector<double> stored;  ///< of the forces that the run has stored, as `talus analyze` has them
  std::vector<ForceSet> sets;  ///< the first is from the stored forces
  std::vector<ForceSpread> spreads;

  int admissible() const;  ///< of the sets but the first
};

/// Looks for the forces of a frozen bed and analyses each set with the functions of an ordinary analysis.
/// `stored` is the frame with its own forces; `theta_c` in rad gives Gamma_c where the parameters do not.
/// Throws Error(bad_data) where neither does, and where the parameters average over frames.
FrameForces admissible_forces(const FrozenBed& bed, const BedFrame& stored,
                              const analysis::AnalysisParameters& parameters, double theta_c,
                              const ForceSearch& search);

/// The same of frame k of a run.
FrameForces admissible_forces(const io::RunFile& run, std::size_t k,
                              const analysis::AnalysisParameters& parameters, const ForceSearch& search);

}  // namespace talus::problems
