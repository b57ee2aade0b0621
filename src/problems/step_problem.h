#pragma once
/// The contact problem of the step that follows a stored frame, formed again from the run file.

#include <optional>

#include "dynamics/step.h"
#include "io/run_file.h"
#include "scenario/scenario.h"

namespace talus::problems {

/// What a problem was made from.
struct StepScales {
  double h = 0.0;              ///< time step, s
  double gravity = 0.0;        ///< m/s^2
  double tilt = 0.0;           ///< of the step, rad
  double mean_diameter = 0.0;  ///< m
  double weight = 0.0;         ///< of the free grains, N per metre of thickness
};

/// How well a run wants a step to be solved, which depends on how fast the bed moves (session/session.h).
struct StepTolerance {
  double velocity = 0.0;  ///< rms of the free grains before the step, over g h
  double asked = 0.0;     ///< residual eta that the run asks of this step
  double at_rest = 0.0;   ///< residual eta that it asks of a bed at rest
};

struct StepProblem {
  solver::ContactProblem problem;
  solver::ContactSolution guess;  ///< impulses of the force memory, and the velocities that they give
  StepScales scales;
  std::optional<StepTolerance> tolerance;  ///< of the run; none where no run asks for one
};

/// The problem of the step that the run took, or would take, after frame k. Positions of a frame are rounded:
/// a contact that carried force and is closed to within this rounding is taken as closed, since gaps of that
/// size would pull the remembered forces apart. Throws Error(bad_data) where the stored scenario or the frame
/// cannot be accepted, and where contacts resist rolling: problems have no moments.
StepProblem problem_after_frame(const io::RunFile& run, std::size_t k);

/// A bed with its grains held where they are: which forces can carry it there?
struct FrozenBed {
  World world;  ///< velocities are zero; its contacts are those of the problem, with the remembered forces
  dynamics::ContactLawParameters law;
  StepProblem step;  ///< of one step from rest; its guess is what is remembered
};

/// Freezes a world. A remembered contact is taken as closed where its gap is within rounding (above), or is
/// one that a bed at rest, with a hundredth of g h, closes in a step.
FrozenBed freeze(World world, const dynamics::StepSettings& settings, double mean_diameter);

/// Frame k of a run frozen at its tilt, with the friction in force. Errors as above.
FrozenBed frozen_frame(const io::RunFile& run, std::size_t k);

/// Share of the weight that the bodies which do not move carry: the sum of their forces against gravity over
/// the weight of the free grains. 1 for a bed at rest.
double carried_weight(const StepProblem& step, const solver::ContactSolution& solution);

}  // namespace talus::problems
