#pragma once
/// Contact problems written by hand.

#include <cstdint>

#include "solver/solve.h"

namespace talus::test {

/// Adds a solid disk of mass m (kg) and radius r (m) with the given free velocity; m = 0 is an immobile body.
void add_body(solver::ContactProblem& problem, double mass, double radius, double vx, double vy,
              double omega);
void add_contact(solver::ContactProblem& problem, Index a, Index b, double nx, double ny, double mu,
                 double cn = 0.0, double ct = 0.0);

/// Returns body 0, of mass 2 and radius 0.1, which falls on the fixed body 1 at 1 m/s and slides at `vx`;
/// `swapped`: body 1 is the first of the contact.
solver::ContactProblem one_contact(double vx, double mu, bool swapped = false);

/// Returns bodies with random masses, radii and velocities, some of them fixed, with random contacts and
/// without geometry.
solver::ContactProblem random_problem(std::uint64_t seed, Index bodies, Index contacts);

/// Returns bodies in the columns of a ring, numbered from the floor upwards irrespective of the column. Each
/// touches the next two above it, and one or two in the column to its right. Contacts are sorted by their
/// first body; each column stands on an immobile body.
solver::ContactProblem columns_problem(std::uint64_t seed, Index columns, Index bodies_each);

/// Returns zero impulses.
solver::ContactSolution no_guess(const solver::ContactProblem& problem);

solver::SolverSettings solver_settings(solver::SolverKind kind, double tolerance, int max_iterations = 5000);
/// Solves from the guess in `solution`, with a new workspace.
solver::SolverReport solve_to(solver::SolverKind kind, const solver::ContactProblem& problem,
                              solver::ContactSolution& solution, double tolerance, int max_iterations = 5000);

/// Returns the largest difference of velocities, m/s; rotation counts by its rim velocity.
double difference(const solver::ContactProblem& problem, const solver::ContactSolution& one,
                  const solver::ContactSolution& other);

}  // namespace talus::test
