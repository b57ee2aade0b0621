#pragma once
/// One step of Moreau and Jean.

#include <array>
#include <string_view>

#include "contact/neighbour_list.h"
#include "core/world.h"
#include "dynamics/contact_law_parameters.h"
#include "solver/solve.h"

namespace talus {

struct StepSettings {
  double h = 1e-3;  ///< time step, s
  double margin =
      0.0;  ///< m: pairs with a smaller gap are contacts of the problem; grows with the velocities
  ContactLawParameters law;
  SolverSettings solver;
};

/// The stages of a step, in their order.
enum class Stage : std::size_t { move, detect, assemble, recall, solve, store, count };
inline constexpr std::size_t stage_count = static_cast<std::size_t>(Stage::count);
inline constexpr std::array<std::string_view, stage_count> stage_names = {"move",   "detect", "assemble",
                                                                          "recall", "solve",  "store"};

struct StepReport {
  SolverReport solver;
  Index contacts = 0;                         ///< in the problem
  double largest_overlap = 0.0;               ///< m, at the midpoint
  double rms_velocity = 0.0;                  ///< m/s, after the step
  std::array<double, stage_count> seconds{};  ///< wall time of each stage; never enters the state
};

/// Memory kept between steps; holds no state of the world.
struct StepWorkspace {
  Grains before;  ///< where the grains were, to go back to when a step fails
  NeighbourList neighbours;
  Contacts contacts;
  ContactProblem problem;
  ContactSolution solution;
  SolverWorkspace solver;
};

/// The first part of a step: moves the grains to the midpoint, and leaves in the workspace their contacts,
/// the problem of the step, and the first guess of its solution from the force memory.
void form_problem(World& world, const StepSettings& settings, StepWorkspace& workspace);

/// Advances the world by h: move to the midpoint, detect contacts, assemble, recall forces, solve, store
/// forces, move to the end (Moreau 1988, Jean 1999). Contacts of the world then hold the mean forces P/h of
/// the step. Throws Error(internal) where a velocity is not finite; the world is then as before the step.
StepReport step(World& world, const StepSettings& settings, StepWorkspace& workspace);

}  // namespace talus
