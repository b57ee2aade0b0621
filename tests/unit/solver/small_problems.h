#pragma once
/// Contact problems written down by hand.

#include <cstdint>

#include "solver/problem.h"

namespace talus::test {

/// A solid disk of mass m (kg) and radius r (m) at the free velocity given; m = 0 is a body that never moves.
void add_body(solver::ContactProblem& problem, double mass, double radius, double vx, double vy,
              double omega);
void add_contact(solver::ContactProblem& problem, Index a, Index b, double nx, double ny, double mu,
                 double cn = 0.0, double ct = 0.0);

/// Body 0 of mass 2 and radius 0.1 falls on the fixed body 1, straight down at 1 m/s and sliding at `vx`.
solver::ContactProblem one_contact(double vx, double mu);

/// Bodies with random masses, radii and velocities, some fixed; random contacts between them, no geometry.
solver::ContactProblem random_problem(std::uint64_t seed, Index bodies, Index contacts);

/// Bodies in the columns of a ring, numbered from the floor upwards with no regard to the column. Each meets
/// the next two above it, and one or two of the column to its right. Contacts are sorted by their first body;
/// each column stands on a body that does not move.
solver::ContactProblem columns_problem(std::uint64_t seed, Index columns, Index bodies_each);

/// No impulses yet.
solver::ContactSolution no_guess(const solver::ContactProblem& problem);

}  // namespace talus::test
