#pragma once
/// Dynamics moves a World: it builds beds (bed.h), forms the contact problem of a step from them
/// (form_problem), lets the solver solve it and moves the grains. It knows time steps, not runs: those are in
/// session.
///
/// One step of Contact Dynamics (Moreau 1988; Jean 1999; docs/theory.md).

#include <array>
#include <string_view>

#include "base/thread_team.h"
#include "contact/neighbour_list.h"
#include "core/world.h"
#include "dynamics/bed.h"
#include "solver/problem.h"
#include "solver/solve.h"

namespace talus::dynamics {

// Parameters of the contact law.

struct ContactLawParameters {
  double friction = 0.5;                ///< mu between grains, and between grains and floor
  double wall_friction = 0.5;           ///< mu with the side walls
  double rolling_friction = 0.0;        ///< mu_r between grains, and between grains and floor; 0 at walls
  double restitution = 0.0;             ///< e_n: U_n+ = -e_n U_n- (Newton)
  double tangential_restitution = 0.0;  ///< e_t: U_t+ = -e_t U_t- of a sticking contact
  double allowed_overlap = 0.0;         ///< m; smaller overlaps are not corrected
  double overlap_correction = 0.05;  ///< largest share of the excess of an overlap over the allowed one that
                                     ///< is removed in a step (T11)
};

// The contact problem of one step, formed from the world and its contacts (docs/theory.md).

/// Forms the contact problem: the bodies with their free velocities v + h g (T4), which are 0 for bodies that
/// do not move, including planes; then the local frames of the contacts, their friction, and the constant c
/// of their relative velocities (T5).
///
/// Normal part: Signorini's condition on U_n + g/h >= 0 for a gap g >= 0 (T11) keeps bodies apart at the next
/// midpoint, q_m + h v, at which the next gaps are computed. The share overlap_correction of the excess of an
/// overlap over the allowed one is removed. Overlaps up to ten times the allowed one, and gaps up to a
/// twentieth of it in contacts that bear load, are errors of earlier solves. They are not corrected faster
/// than the `tolerance` of a solve lets them arise, relative to the forces remembered in `contacts`. A
/// contact that the free motion would close within the step, with U_n- < 0, obeys U_n >= -e_n U_n- instead if
/// that is larger (T12). Tangential part: c_t = e_t U_t- for a contact that is closed or closes. A team, if
/// given, does the work together; the result is the same.
void form_problem(const World& world, const Contacts& contacts, const ContactLawParameters& law, double h,
                  double tolerance, solver::ContactProblem& problem, ThreadTeam* team = nullptr);

// The position of rest of a grain that falls and rolls over others under gravity, without inertia (Visscher
// and Bolsterli 1972, Nature 239, 504).

/// A grain to be placed on a bed.
struct FallingGrain {
  double x = 0.0;       ///< m, position of the line along which it falls
  double radius = 0.0;  ///< m
  /// Sine of the largest angle between contact normal and vertical at which the grain stays where it has
  /// landed on another one (Bratberg, Radjai and Hansen 2002); 0: it always rolls.
  double critical_sine = 0.0;
};

/// Returns the position of its centre at rest, m; x in [0, length) of a periodic bed. The grain falls until
/// it touches, rolls down from one grain to the next until a body on the other side holds it, and falls again
/// after it has rolled down to the equator of a grain. At rest it overlaps no body beyond round-off. The
/// floor of the bed must have no holes. Throws Error(internal) if the path does not end.
Vec2 resting_place(const DiscGrid& bed, const FallingGrain& grain);

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
