/// Problems at the limits of the theory: without contacts, hyperstatic, jammed, ill-conditioned, or without a
/// solution. Each solver converges or reports the residual; no number is ever undefined.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "core/trigonometry.h"
#include "solver/solve.h"
#include "support/scenes.h"
#include "unit/solver/small_problems.h"

namespace talus::solver {
namespace {

constexpr double tolerance = 1e-8;
constexpr double fall = 9.81 * test::time_step;  ///< m/s, gain of velocity by gravity in one step

// ---- worlds ----

ContactProblem problem_of(const World& world, double friction = 0.5) {
  return test::next_problem(world, test::bed_step(tolerance, friction)).problem;
}

/// Returns a world with gravity, the smooth plane y = 0 and, at x = 0 and x = length, walls or a periodic
/// edge.
World empty_box(double length, bool periodic) {
  World world;
  world.boundary.periodic = periodic;
  world.boundary.length = length;
  world.boundary.planes.push_back({.normal = {0.0, 1.0}, .offset = 0.0, .wall = false});
  if (periodic) return world;
  world.boundary.planes.push_back({.normal = {1.0, 0.0}, .offset = 0.0});
  world.boundary.planes.push_back({.normal = {-1.0, 0.0}, .offset = -length});
  return world;
}

World all_floor() {
  World world = empty_box(0.1, true);
  for (int i = 0; i < 10; ++i)
    add_disk(world.grains, {(2 * i + 1) * test::radius, -test::radius}, test::radius, test::density, true);
  return world;
}

/// Returns equal disks on a lattice, each touching all its neighbours: a strongly hyperstatic packing.
World crystal(bool hexagonal, bool periodic) {
  constexpr Index columns = 8, rows = 8;
  const double spacing = 2.0 * test::radius;
  World world = empty_box(columns * spacing, periodic);
  const double row_height = hexagonal ? 0.5 * std::sqrt(3.0) * spacing : spacing;
  for (Index row = 0; row < rows; ++row) {
    const bool shifted = hexagonal && row % 2 == 1;
    const Index count = shifted && !periodic ? columns - 1 : columns;
    for (Index column = 0; column < count; ++column)
      add_disk(world.grains, {(column + (shifted ? 1.0 : 0.5)) * spacing, test::radius + row * row_height},
               test::radius, test::density, false);
  }
  return world;
}

/// Returns one falling disk between walls that open by `opening` on each side (0: parallel).
World wedged(double opening, double overlap) {
  World world;
  const Vec2 right{std::cos(opening), std::sin(opening)};
  const double distance = test::radius - overlap;
  world.boundary.planes = {{.normal = right, .offset = -distance},
                           {.normal = {-right.x, right.y}, .offset = -distance}};
  add_disk(world.grains, {0.0, 0.0}, test::radius, test::density, false);
  return world;
}

World light_between_floor_and_heavy(double mass_ratio) {
  World world = test::disk_on_plane(0.0);
  add_disk(world.grains, {0.1, 3.0 * test::radius}, test::radius, test::density * mass_ratio, false);
  return world;
}

/// Returns a column, a disk far from it, and one that almost touches the plane.
World rattlers_next_to_a_column() {
  World world = test::column(10);
  add_disk(world.grains, {0.5, 0.5}, test::radius, test::density, false);
  add_disk(world.grains, {0.7, 1.01 * test::radius}, test::radius, test::density, false);
  return world;
}

/// Returns two disks that touch each other on both sides of a period; one rests on the plane, and the other
/// moves down onto it.
World pair_with_two_contacts() {
  World world = empty_box(4.0 * test::radius, true);
  for (double x : {1.0, 3.0})
    add_disk(world.grains, {x * test::radius, test::radius}, test::radius, test::density, false);
  world.grains.vx = {0.1, -0.2};
  world.grains.vy = {0.0, -0.3};
  return world;
}

/// Returns disks at random places of a box with room for a third of them; two have the same centre.
World crushed() {
  World world = test::random_cloud(3, 30, false, 6.0 * test::radius);
  world.grains.x[1] = world.grains.x[0];
  world.grains.y[1] = world.grains.y[0];
  return world;
}

// ---- checks ----

bool finite(const ContactSolution& solution) {
  for (const auto* field : {&solution.pn, &solution.pt, &solution.vx, &solution.vy, &solution.omega})
    if (!std::all_of(field->begin(), field->end(), [](double value) { return std::isfinite(value); }))
      return false;
  return true;
}

/// Solves from the guess in `solution`, and checks that the result is finite and admissible and that the
/// report is correct.
SolverReport solve_and_check_report(SolverKind kind, const ContactProblem& problem, ContactSolution& solution,
                                    int max_iterations = 5000) {
  SCOPED_TRACE(test::name_of(kind));
  const SolverReport report = test::solve_to(kind, problem, solution, tolerance, max_iterations);
  EXPECT_TRUE(finite(solution));
  for (Index c = 0; c < problem.contact_count(); ++c) {
    EXPECT_GE(solution.pn[c], 0.0);
    EXPECT_LE(std::fabs(solution.pt[c]), problem.mu[c] * solution.pn[c] * (1.0 + 1e-15));
  }
  ContactSolution again = solution;
  velocities_from_impulses(problem, again);
  const double eta = natural_map_residual(problem, again).eta;
  EXPECT_TRUE(std::isfinite(report.residual.eta));
  EXPECT_NEAR(report.residual.eta, eta, 1e-5 * eta + 1e-12);
  EXPECT_EQ(report.converged, report.residual.eta <= tolerance * (1.0 + 1e-9));
  return report;
}

ContactSolution free_motion(const ContactProblem& problem) {
  ContactSolution solution = test::no_guess(problem);
  velocities_from_impulses(problem, solution);
  return solution;
}

ContactSolution rest(const ContactProblem& problem) {
  ContactSolution solution = test::no_guess(problem);
  solution.vx = solution.vy = solution.omega = std::vector<double>(problem.vx.size(), 0.0);
  return solution;
}

/// Solvers that must reach the tolerance. The others may fail, but must report it.
enum class Convergence { nobody, accelerated, both };

struct DegenerateCase {
  std::string name;
  ContactProblem problem;
  Convergence converges = Convergence::both;
  bool rests = false;  ///< whether the solution must remain at rest
};

void PrintTo(const DegenerateCase& degenerate, std::ostream* out) { *out << degenerate.name; }

class DegenerateProblem : public testing::TestWithParam<DegenerateCase> {};

TEST_P(DegenerateProblem, ends_converged_or_says_what_is_left) {
  const ContactProblem& problem = GetParam().problem;
  ContactSolution swept = test::no_guess(problem);
  ContactSolution accelerated = swept;
  const SolverReport first = solve_and_check_report(SolverKind::gauss_seidel, problem, swept);
  const SolverReport second = solve_and_check_report(SolverKind::accelerated, problem, accelerated);
  EXPECT_TRUE(first.converged || GetParam().converges != Convergence::both) << first.residual.eta;
  EXPECT_TRUE(second.converged || GetParam().converges == Convergence::nobody) << second.residual.eta;
  const double scale = std::max(fall, test::difference(problem, free_motion(problem), rest(problem)));
  if (first.converged && second.converged) {
    EXPECT_LT(test::difference(problem, swept, accelerated), 1e-5 * scale);
  }
  if (GetParam().rests) {
    // The errors of all contacts in a column add up.
    EXPECT_LT(test::difference(problem, accelerated, rest(problem)), 1e-3 * fall);
  }
}

// Bodies without contact fall freely, bit for bit, independently of the others.
TEST_P(DegenerateProblem, bodies_without_contact_fall_freely) {
  const ContactProblem& problem = GetParam().problem;
  std::vector<bool> touched(problem.vx.size(), false);
  for (Index c = 0; c < problem.contact_count(); ++c) touched[problem.a[c]] = touched[problem.b[c]] = true;
  for (SolverKind kind : test::both_solvers) {
    ContactSolution solution = test::no_guess(problem);
    solve_and_check_report(kind, problem, solution);
    for (Index i = 0; i < problem.body_count(); ++i) {
      if (touched[i]) continue;
      EXPECT_EQ(solution.vx[i], problem.vx[i]);
      EXPECT_EQ(solution.vy[i], problem.vy[i]);
      EXPECT_EQ(solution.omega[i], problem.omega[i]);
    }
  }
}

// The guess may be almost zero, because impulses decay geometrically, or belong to another load.
TEST_P(DegenerateProblem, a_guess_of_any_size_does_no_harm) {
  const ContactProblem& problem = GetParam().problem;
  for (double size : {1e-310, 1e-49, 1e-20, 1e6}) {
    SCOPED_TRACE(size);
    for (SolverKind kind : test::both_solvers) {
      ContactSolution solution = test::no_guess(problem);
      std::fill(solution.pn.begin(), solution.pn.end(), size);
      solve_and_check_report(kind, problem, solution, 500);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Problems, DegenerateProblem,
    testing::ValuesIn(std::vector<DegenerateCase>{
        {.name = "nothing", .problem = ContactProblem{}},
        {.name = "no_contact", .problem = problem_of(test::two_disks(0.0, {1.0, 0.0}, {2.0, 0.0}, 1e-3))},
        {.name = "one_contact", .problem = test::one_contact(0.6, 0.5)},
        {.name = "all_floor", .problem = problem_of(all_floor())},
        {.name = "wedge_without_friction",
         .problem = problem_of(wedged(radians(10.0), 0.0), 0.0),
         .rests = true},
        {.name = "wedge_that_jams", .problem = problem_of(wedged(radians(10.0), 0.0), 0.5), .rests = true},
        {.name = "wedge_that_jams_hard",
         .problem = problem_of(wedged(radians(10.0), 0.0), 10.0),
         .rests = true},
        {.name = "parallel_walls", .problem = problem_of(wedged(0.0, 0.0), 10.0)},
        {.name = "parallel_walls_too_narrow",
         .problem = problem_of(wedged(0.0, 1e-3), 0.5),
         .converges = Convergence::nobody},
        {.name = "heavy_below_light",
         .problem = problem_of(light_between_floor_and_heavy(1e-6)),
         .rests = true},
        {.name = "light_below_heavy",
         .problem = problem_of(light_between_floor_and_heavy(1e6)),
         .converges = Convergence::nobody},
        {.name = "hexagonal_periodic", .problem = problem_of(crystal(true, true)), .rests = true},
        {.name = "hexagonal_walled", .problem = problem_of(crystal(true, false)), .rests = true},
        {.name = "hexagonal_without_friction",
         .problem = problem_of(crystal(true, true), 0.0),
         .rests = true},
        {.name = "hexagonal_rough", .problem = problem_of(crystal(true, false), 10.0), .rests = true},
        {.name = "square_periodic", .problem = problem_of(crystal(false, true)), .rests = true},
        {.name = "square_walled", .problem = problem_of(crystal(false, false)), .rests = true},
        {.name = "square_rough", .problem = problem_of(crystal(false, false), 10.0), .rests = true},
        {.name = "tall_column",
         .problem = problem_of(test::column(200)),
         .converges = Convergence::accelerated,
         .rests = true},
        {.name = "rattlers", .problem = problem_of(rattlers_next_to_a_column())},
        {.name = "two_contacts_of_one_pair", .problem = problem_of(pair_with_two_contacts())},
        {.name = "crushed", .problem = problem_of(crushed())},
        {.name = "crushed_rough", .problem = problem_of(crushed(), 10.0), .converges = Convergence::nobody}}),
    [](const auto& parameter) { return parameter.param.name; });

}  // namespace
}  // namespace talus::solver
