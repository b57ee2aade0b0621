#pragma once
/// Small worlds for tests, and what is asked of all of them.

#include <cstdint>
#include <string>

#include "core/world.h"
#include "dynamics/bed.h"
#include "dynamics/step.h"

namespace talus::test {

inline constexpr double radius = 0.005;    ///< of the disks of the smallest scenes, m
inline constexpr double density = 2500.0;  ///< kg/m^3
inline constexpr double time_step = 1e-3;  ///< s

/// Both solvers, for tests that each must pass, and their names.
inline constexpr solver::SolverKind both_solvers[] = {solver::SolverKind::gauss_seidel,
                                                      solver::SolverKind::accelerated};
std::string name_of(solver::SolverKind kind);

/// A step that is solved as far as doubles go in a scene of a few contacts.
dynamics::StepSettings exact_step(solver::SolverKind kind, double friction = 0.5);
/// A step as a bed needs it: candidates within 2 % of the diameter, the tolerance of a run at rest.
dynamics::StepSettings bed_step(double tolerance = 1e-6, double friction = 0.5);

/// A disk that touches the smooth plane y = 0, at rest.
World disk_on_plane(double tilt);
/// Two disks without gravity that will just touch at the midpoint of the next step: b seen from a in the
/// direction `angle`, with the velocities given.
World two_disks(double angle, Vec2 velocity_a, Vec2 velocity_b, double radius_a = radius,
                double radius_b = 1.4 * radius);
/// `count` touching disks on top of each other on the plane y = 0.
World column(Index count);
/// Grains with random places and velocities in a periodic or open box, without gravity. They may overlap.
World random_cloud(std::uint64_t seed, Index count, bool periodic, double length);

/// A loose bed of `count` grains, `columns` mean diameters long.
dynamics::BedPlan bed_plan(bool periodic, Index count, Index columns, std::uint64_t seed);
/// The bed of a plan after `steps` steps of falling and settling.
World fallen_bed(const dynamics::BedPlan& plan, const dynamics::StepSettings& settings, int steps);
/// Takes steps until the world is at rest: its rms velocity stayed below 1e-3 g h for 50 steps.
/// Fails the test where that takes more than 10 000 steps.
void come_to_rest(World& world, const dynamics::StepSettings& settings, dynamics::StepWorkspace& workspace);
/// The bed of a plan when it has come to rest.
World settled_bed(const dynamics::BedPlan& plan, const dynamics::StepSettings& settings);

/// What the solver sees in the next step of a world: the first half of step().
struct FrozenStep {
  Contacts contacts;
  solver::ContactProblem problem;
  solver::ContactSolution guess;  ///< the remembered forces
};
FrozenStep next_problem(const World& world, const dynamics::StepSettings& settings);

/// Sums over the free grains: momentum, and angular momentum about the origin.
struct Momentum {
  double x = 0.0, y = 0.0, angular = 0.0;
};
Momentum momentum(const Grains& grains);

/// Kinetic energy and height energy of the free grains in the gravity of the world, J per metre.
double mechanical_energy(const World& world);
/// Weight of the free grains, N per metre.
double weight(const World& world);

}  // namespace talus::test
