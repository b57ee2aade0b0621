#pragma once
/// Small worlds for tests, and quantities measured in them.

#include <cstdint>
#include <string>

#include "core/world.h"
#include "dynamics/bed.h"
#include "dynamics/step.h"

namespace talus::test {

inline constexpr double radius = 0.005;    ///< m, radius of the disks of the smallest scenes
inline constexpr double density = 2500.0;  ///< kg/m^3
inline constexpr double time_step = 1e-3;  ///< s

/// Both solvers, for tests that each must pass, and their names.
inline constexpr solver::SolverKind both_solvers[] = {solver::SolverKind::gauss_seidel,
                                                      solver::SolverKind::accelerated};
std::string name_of(solver::SolverKind kind);

/// Returns settings that solve a scene of a few contacts to double precision.
dynamics::StepSettings exact_step(solver::SolverKind kind, double friction = 0.5);
/// Returns settings for a bed: candidates within 2 % of the diameter, and the tolerance of a run at rest.
dynamics::StepSettings bed_step(double tolerance = 1e-6, double friction = 0.5);

/// Returns a disk at rest that touches the smooth plane y = 0.
World disk_on_plane(double tilt);
/// Returns two disks without gravity that will just touch at the midpoint of the next step: b lies in the
/// direction `angle` from a, with the given velocities.
World two_disks(double angle, Vec2 velocity_a, Vec2 velocity_b, double radius_a = radius,
                double radius_b = 1.4 * radius);
/// Returns `count` touching disks on top of each other on the plane y = 0.
World column(Index count);
/// Returns grains with random places and velocities in a periodic or open box, without gravity. They may
/// overlap.
World random_cloud(std::uint64_t seed, Index count, bool periodic, double length);

/// Returns the plan of a loose bed of `count` grains, `columns` mean diameters long.
dynamics::BedPlan bed_plan(bool periodic, Index count, Index columns, std::uint64_t seed);
/// Returns the bed of a plan after `steps` steps of falling and settling.
World fallen_bed(const dynamics::BedPlan& plan, const dynamics::StepSettings& settings, int steps);
/// Steps until the world is at rest, with an rms velocity below 1e-3 g h for 50 steps. Fails the test if that
/// takes more than 10 000 steps.
void come_to_rest(World& world, const dynamics::StepSettings& settings, dynamics::StepWorkspace& workspace);
/// Returns the bed of a plan after it has come to rest.
World settled_bed(const dynamics::BedPlan& plan, const dynamics::StepSettings& settings);

/// Input of the solver for the next step of a world, from the first half of step().
struct FrozenStep {
  Contacts contacts;
  solver::ContactProblem problem;
  solver::ContactSolution guess;  ///< remembered forces
};
FrozenStep next_problem(const World& world, const dynamics::StepSettings& settings);

/// Sums over the free grains: momentum, and angular momentum about the origin.
struct Momentum {
  double x = 0.0, y = 0.0, angular = 0.0;
};
Momentum momentum(const Grains& grains);

/// Returns the smallest gap between a free grain and other grains, their periodic images and the floor, m.
double smallest_gap(const World& world, Index grain);
/// Returns the smallest of all free grains.
double smallest_gap(const World& world);

/// Returns kinetic and potential energy of the free grains in the gravity of the world, J per metre.
double mechanical_energy(const World& world);
/// Returns the weight of the free grains, N per metre.
double weight(const World& world);

}  // namespace talus::test
