#pragma once
/// The contact problem of the next step of a bed, frozen to be solved again and again.

#include "core/world.h"
#include "dynamics/step.h"
#include "solver/problem.h"

namespace talus::bench {

struct FrozenStep {
  solver::ContactProblem problem;
  solver::ContactSolution guess;  ///< remembered forces times h
  double gravity_step = 0.0;      ///< g h, the velocity that gravity gives a free grain in the step
};

/// Which near contacts are in the problem: those with a gap below this many mean diameters, and what the
/// velocities add to it (begin_step).
enum class Candidates {
  of_a_run,  ///< 0.002 D
  close,     ///< 0.0002 D: those that may close in this step; Siconos's error is relative to the largest of
             ///< three norms, and the gap / h of more distant ones would be all there is in them
};

/// What a run of the paper's scenario asks of a step of length h (s).
dynamics::StepSettings run_settings(double h, Candidates candidates = Candidates::of_a_run);

/// In SI units.
FrozenStep next_step(World world, double h, Candidates candidates = Candidates::of_a_run);

/// dt sqrt(D / g), s.
double seconds_of(double dt);

/// The step of length `dt` sqrt(D / g) with D, the mean mass m of the grains that move, and g as units.
FrozenStep dimensionless_next_step(const World& world, double dt, Candidates candidates);

/// No impulses.
solver::ContactSolution cold_guess(const solver::ContactProblem& problem);

}  // namespace talus::bench
