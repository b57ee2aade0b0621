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
  /// Gap below which pairs are contacts of the problem, m. In each step it is doubled until it exceeds this
  /// value by the distance that bodies can approach in the step.
  double margin = 0.0;
  ContactLawParameters law;
  solver::SolverSettings solver;
};

/// Stages of a step, in their order.
enum class Stage : std::size_t { move, detect, recall, assemble, solve, store, count };
inline constexpr std::size_t stage_count = static_cast<std::size_t>(Stage::count);
inline constexpr std::array<std::string_view, stage_count> stage_names = {"move",     "detect", "recall",
                                                                          "assemble", "solve",  "store"};

/// Wall time of each stage, s. It never enters the state.
using StageSeconds = std::array<double, stage_count>;

struct StepReport {
  solver::SolverReport solver;
  Index contacts = 0;            ///< number of contacts in the problem
  double largest_overlap = 0.0;  ///< m, at the midpoint
  Motion motion;                 ///< motion after the step
  StageSeconds seconds{};
};

/// Memory kept between steps. It contains no state of the world.
struct StepWorkspace {
  Grains before;             ///< positions before the step, restored if it fails
  std::vector<Index> image;  ///< periodic images of the grains at the midpoint
  contact::NeighbourList neighbours;
  Contacts contacts;
  solver::ContactProblem problem;
  solver::ContactSolution solution;
  solver::SolverWorkspace solver;
};

/// Performs the step up to its solve: moves the grains to the midpoint, and stores in the workspace their
/// contacts, the problem of the step, and the recalled impulses as the first guess of its solution. Returns
/// the wall times of its stages.
StageSeconds begin_step(World& world, const StepSettings& settings, StepWorkspace& workspace);

/// Advances the world by h by the scheme of Moreau and Jean, (T1) to (T18) of docs/theory.md: midpoint
/// positions, contacts and local frames, free velocities, contact problem, recalled impulses, solve, stored
/// impulses, velocities, positions. The contacts of the world then hold the mean forces P/h of the step.
/// Throws Error(internal) if a velocity is not finite; the world is then the same as before the step.
StepReport step(World& world, const StepSettings& settings, StepWorkspace& workspace);

}  // namespace talus::dynamics
