#pragma once
/// The contact problem of the next step of a bed, frozen for repeated solution.

#include "core/world.h"
#include "dynamics/step.h"
#include "solver/problem.h"

namespace talus::bench {

struct FrozenStep {
  solver::ContactProblem problem;
  solver::ContactSolution guess;  ///< remembered forces times h
  double gravity_step = 0.0;      ///< g h, the velocity that gravity gives a free grain in the step
};

/// Limit of the gap of near contacts in the problem, to which the velocities add (begin_step).
enum class Candidates {
  of_a_run,  ///< 0.002 D
  close,     ///< 0.0002 D: contacts that may close in this step. The gap / h of more distant ones would
             ///< dominate the norms to which Siconos's error is relative
};

/// Returns the settings that a run of the paper's scenario uses for a step of length h (s).
dynamics::StepSettings run_settings(double h, Candidates candidates = Candidates::of_a_run);

/// Returns the next step of length h (s), in SI units.
FrozenStep next_step(World world, double h, Candidates candidates = Candidates::of_a_run);

/// Returns dt sqrt(D / g), s.
double seconds_of(double dt);

/// Returns the step of length `dt` sqrt(D / g) in units of D, of the mean mass m of the free grains, and of
/// g.
FrozenStep dimensionless_next_step(const World& world, double dt, Candidates candidates);

/// Returns a first guess of zero impulses.
solver::ContactSolution cold_guess(const solver::ContactProblem& problem);

}  // namespace talus::bench
