#pragma once
/// The contact problem of the step after a stored frame, formed again from the run file.

#include <optional>

#include "dynamics/step.h"
#include "io/run_file.h"
#include "scenario/scenario.h"

namespace talus::problems {

/// Physical scales of the step of a problem.
struct StepScales {
  double h = 0.0;              ///< time step, s
  double gravity = 0.0;        ///< m/s^2
  double tilt = 0.0;           ///< tilt in the step, rad
  double mean_diameter = 0.0;  ///< m
  double weight = 0.0;         ///< weight of the free grains, N per metre of thickness
};

/// Tolerance that a run requires of a step. It depends on the velocity of the bed (session/session.h).
struct StepTolerance {
  double velocity = 0.0;  ///< rms velocity of the free grains before the step, over g h
  double asked = 0.0;     ///< residual eta that the run requires of this step
  double at_rest = 0.0;   ///< residual eta that it requires of a bed at rest
};

struct StepProblem {
  solver::ContactProblem problem;
  solver::ContactSolution guess;  ///< impulses of the force memory, and the velocities that they give
  StepScales scales;
  std::optional<StepTolerance> tolerance;  ///< tolerance of the run; empty if no run specifies one
};

/// Returns the problem of the step that the run took, or would take, after frame k. Positions in a frame are
/// rounded. A contact that carried force and is closed within this rounding is considered closed, because
/// gaps of that size are inconsistent with the remembered forces. Throws Error(bad_data) if the stored
/// scenario or the frame is invalid, or if contacts resist rolling, because problems have no moments.
StepProblem problem_after_frame(const io::RunFile& run, std::size_t k);

/// A bed with its grains held in place, to find the forces that can carry it.
struct FrozenBed {
  World world;  ///< world with zero velocities; its contacts are those of the problem, with the remembered
                ///< forces
  dynamics::ContactLawParameters law;
  StepProblem step;  ///< problem of one step from rest; its guess holds the remembered forces
};

/// Freezes a world. A remembered contact is considered closed if its gap is within rounding (see
/// problem_after_frame), or if a bed at rest, with a hundredth of g h, closes it in a step.
FrozenBed freeze(World world, const dynamics::StepSettings& settings, double mean_diameter);

/// Freezes frame k of a run at its tilt, with the friction in effect. Throws the errors of
/// problem_after_frame.
FrozenBed frozen_frame(const io::RunFile& run, std::size_t k);

/// Returns the share of the weight carried by the bodies that do not move: the sum of their forces against
/// gravity over the weight of the free grains. 1 for a bed at rest.
double carried_weight(const StepProblem& step, const solver::ContactSolution& solution);

}  // namespace talus::problems
