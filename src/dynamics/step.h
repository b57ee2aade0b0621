#pragma once
/// One step of Contact Dynamics (Moreau 1988; Jean 1999; docs/theory.md).

#include <array>
#include <string_view>

#include "contact/neighbour_list.h"
#include "core/world.h"
#include "dynamics/contact_law_parameters.h"
#include "solver/solve.h"

namespace talus::dynamics {

struct StepSettings {
  double h = 1e-3;  ///< time step, s
  /// Pairs with a smaller gap are contacts of the problem, m. Doubled until it exceeds
  /// itself by what the velocities of the bed can close in a step.
  double margin = 0.0;
  ContactLawParameters law;
  solver::SolverSettings solver;
};

/// The stages of a step, in their order.
enum class Stage : std::size_t { move, detect, recall, assemble, solve, store, count };
inline constexpr std::size_t stage_count = static_cast<std::size_t>(Stage::count);
inline constexpr std::array<std::string_view, stage_count> stage_names = {"move",     "detect", "recall",
                                                                          "assemble", "solve",  "store"};

/// Wall time of each stage, s; never enters the state.
using StageSeconds = std::array<double, stage_count>;

struct StepReport {
  solver::SolverReport solver;
  Index contacts = 0;            ///< in the problem
  double largest_overlap = 0.0;  ///< m, at the midpoint
  Motion motion;                 ///< after the step
  StageSeconds seconds{};
};

/// Memory kept between steps; holds no state of the world.
struct StepWorkspace {
  Grains before;             ///< where the grains were, to go back to when a step fails
  std::vector<Index> image;  ///< of the grains at the midpoint
  contact::NeighbourList neighbours;
  Contacts contacts;
  solver::ContactProblem problem;
  solver::ContactSolution solution;
  solver::SolverWorkspace solver;
};

/// The step up to its solve: moves the grains to the midpoint, and leaves in the workspace their contacts,
/// the problem of the step, and the recalled impulses as the first guess of its solution. Returns the time
/// that its stages took.
StageSeconds begin_step(World& world, const StepSettings& settings, StepWorkspace& workspace);

/// Advances the world by h by the scheme of Moreau and Jean, (T1) to (T18) of docs/theory.md: midpoint
/// positions, contacts and local frames, free velocities, contact problem, recalled impulses, solve, stored
/// impulses, velocities, positions. Contacts of the world then hold the mean forces P/h of the step. Throws
/// Error(internal) where a velocity is not finite; the world is then as before the step.
StepReport step(World& world, const StepSettings& settings, StepWorkspace& workspace);

}  // namespace talus::dynamics
