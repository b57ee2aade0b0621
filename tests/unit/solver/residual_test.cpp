/// The residual of a solution, and the mean of iterates. The law of a contact.

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "solver/local_problem.h"
#include "solver/problem.h"
#include "solver/solve.h"
#include "support/scenes.h"
#include "unit/solver/small_problems.h"

namespace talus::solver {
namespace {

Residual residual_at(const ContactProblem& problem, const std::vector<double>& pn,
                     const std::vector<double>& pt) {
  ContactSolution solution;
  solution.pn = pn;
  solution.pt = pt;
  velocities_from_impulses(problem, solution);
  return natural_map_residual(problem, solution);
}

// A disk of 2 kg is stopped from 1 m/s: P_n = 2. It slides at 0.6 m/s with w_t = m / 3, so P_t = 0.4 stops
// the slip.
TEST(Residual, is_zero_at_a_solution) {
  const ContactProblem problem = test::one_contact(0.6, 0.5);
  const Residual solved = residual_at(problem, {2.0}, {0.4});
  EXPECT_NEAR(solved.eta, 0.0, 1e-15);
  EXPECT_NEAR(solved.largest, 0.0, 1e-15);
}

// At P = (1.5, 0): P' = (2, 0.4), so eta = |(0.5, 0.4)| / 1.5.
TEST(Residual, is_the_change_of_a_jacobi_step_over_the_impulse) {
  const Residual residual = residual_at(test::one_contact(0.6, 0.5), {1.5}, {0.0});
  EXPECT_NEAR(residual.eta, std::hypot(0.5, 0.4) / 1.5, 1e-15);
  EXPECT_NEAR(residual.largest, residual.eta, 1e-15);
}

// At P = (1.5, 0) with mu = 0.1 friction is limited to mu P'_n = 0.2.
TEST(Residual, knows_the_cone_of_the_next_normal_impulse) {
  const Residual residual = residual_at(test::one_contact(0.6, 0.1), {1.5}, {0.0});
  EXPECT_NEAR(residual.eta, std::hypot(0.5, 0.2) / 1.5, 1e-15);
}

TEST(Residual, of_no_impulse_is_measured_by_the_one_that_is_missing) {
  EXPECT_DOUBLE_EQ(residual_at(test::one_contact(0.6, 0.5), {0.0}, {0.0}).eta, 1.0);
}

TEST(Residual, is_zero_where_nothing_touches) {
  ContactProblem problem = test::one_contact(0.0, 0.5);
  problem.cn[0] = 1.5;  // the gap closes only at 1.5 m/s
  EXPECT_EQ(residual_at(problem, {0.0}, {0.0}).eta, 0.0);
  EXPECT_EQ(natural_map_residual(ContactProblem{}, ContactSolution{}).eta, 0.0);
}

// Two separate disks, one solved and one lacking 1 N s: the largest contribution is the latter's, and eta
// sums squares.
TEST(Residual, names_the_largest_share) {
  ContactProblem problem = test::one_contact(0.0, 0.5);
  test::add_body(problem, 2.0, 0.1, 0.0, -1.0, 0.0);
  test::add_body(problem, 2.0, 0.1, 0.0, -1.0, 0.0);
  test::add_contact(problem, 1, 2, 0.0, 1.0, 0.5);
  test::add_contact(problem, 1, 3, 0.0, 1.0, 0.5);
  const Residual residual = residual_at(problem, {2.0, 1.0, 1.5}, {0.0, 0.0, 0.0});
  const double norm = std::sqrt(4.0 + 1.0 + 2.25);
  EXPECT_NEAR(residual.eta, std::sqrt(1.0 + 0.25) / norm, 1e-15);
  EXPECT_NEAR(residual.largest, 1.0 / norm, 1e-15);
}

// The residual does not change with the units of mass, length and time.
TEST(Residual, does_not_depend_on_units) {
  const ContactProblem problem = test::random_problem(2, 12, 25);
  ContactProblem scaled = problem;
  const double mass = 1000.0, length = 0.01, time = 60.0;
  const double velocity = length / time;
  for (auto* field : {&scaled.vx, &scaled.vy, &scaled.cn, &scaled.ct})
    for (double& value : *field) value *= velocity;
  for (double& value : scaled.omega) value /= time;
  for (double& value : scaled.lever) value *= length;
  for (double& value : scaled.inverse_mass) value /= mass;
  for (double& value : scaled.inverse_inertia) value /= mass * length * length;
  std::vector<double> pn(25, 0.25), pt(25, 0.0);
  const Residual residual = residual_at(problem, pn, pt);
  for (double& value : pn) value *= mass * velocity;
  EXPECT_GT(residual.eta, 0.1);
  EXPECT_NEAR(residual_at(scaled, pn, pt).eta, residual.eta, 1e-13);
}

TEST(MeanOfIterates, is_that_of_all_values_since_the_first) {
  const ContactProblem problem = test::random_problem(3, 20, 3);
  Linearisation at;
  ContactSolution mean;
  at.pn = at.pt = mean.pn = mean.pt = {0.0, 0.0, 0.0};
  const auto take = [&](int count, double normal, double tangential) {
    at.pn = {normal, 0.0, 2.0 * normal};
    at.pt = {0.0, tangential, -tangential};
    average_impulses(problem, 0, 1, at, count, mean);
  };
  take(1, 100.0, 100.0);
  take(1, 1.0, 4.0);  // equal to the first: earlier iterates are discarded
  take(2, 2.0, -4.0);
  take(3, 6.0, 3.0);
  const std::vector<double> normal = {3.0, 0.0, 6.0}, tangential = {0.0, 1.0, -1.0};
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(mean.pn[c], normal[c], 1e-14);
    EXPECT_NEAR(mean.pt[c], tangential[c], 1e-14);
  }
}

/// Returns impulses and iterations of a problem that does not converge before means are taken.
ContactSolution solved(const ContactProblem& problem, int threads, AcceleratedOutcome& outcome) {
  AcceleratedWorkspace workspace;
  ContactSolution solution = test::no_guess(problem);
  outcome = solve_accelerated(problem, 1e-300, 580, threads, workspace, solution);
  return solution;
}

// 580 iterations contain one mean.
TEST(MeanOfIterates, has_the_same_bits_on_any_number_of_threads) {
  const ContactProblem problem = test::columns_problem(1, 100, 15);
  ASSERT_GT(problem.contact_count(), 1000) << "enough for a team";
  AcceleratedOutcome one, three;
  const ContactSolution alone = solved(problem, 1, one), in_team = solved(problem, 3, three);
  EXPECT_EQ(one.iterations, 580);
  EXPECT_EQ(three.iterations, 580);
  EXPECT_EQ(one.residual.eta, three.residual.eta);
  EXPECT_EQ(alone.pn, in_team.pn);
  EXPECT_EQ(alone.pt, in_team.pt);
}

/// Returns a step of a falling bed whose iterates form a limit cycle.
test::FrozenStep step_in_circles() {
  const dynamics::StepSettings settings = test::bed_step(1e-6);
  return test::next_problem(test::fallen_bed(test::bed_plan(false, 150, 16, 21), settings, 128), settings);
}

// Without the mean, the residual of the solve stays at 6e-5 for any number of iterations.
TEST(MeanOfIterates, ends_a_step_that_goes_round_in_circles) {
  test::FrozenStep frozen = step_in_circles();
  AcceleratedWorkspace workspace;
  const AcceleratedOutcome outcome =
      solve_accelerated(frozen.problem, 1e-5, 2000, 1, workspace, frozen.guess);
  EXPECT_LE(outcome.residual.eta, 1e-5);
  EXPECT_GT(outcome.iterations, 512) << "before means are taken";
}

// One case in which the mean is better, and one in which it is not and the last iterate stays.
TEST(MeanOfIterates, leaves_the_impulses_whose_residual_is_told) {
  const test::FrozenStep frozen = step_in_circles();
  for (int most = 512 + 16; most <= 1024; most += 16) {
    AcceleratedWorkspace workspace;
    ContactSolution solution = frozen.guess;
    const AcceleratedOutcome outcome =
        solve_accelerated(frozen.problem, 1e-300, most, 1, workspace, solution);
    velocities_from_impulses(frozen.problem, solution);
    const double eta = natural_map_residual(frozen.problem, solution).eta;
    EXPECT_NEAR(outcome.residual.eta, eta, 1e-5 * eta + 1e-14) << most;
  }
}

RelativeVelocity after(const DelassusBlock& w, Impulse p, RelativeVelocity b) {
  return {b.normal + w.nn * p.normal + w.nt * p.tangential,
          b.tangential + w.tn * p.normal + w.tt * p.tangential};
}

/// Expects one contact to satisfy Signorini and Coulomb to round-off.
void expect_lawful(Impulse p, RelativeVelocity u, double mu) {
  constexpr double small = 1e-12;
  EXPECT_GE(p.normal, 0.0);
  EXPECT_GE(u.normal, -small);
  EXPECT_NEAR(p.normal * u.normal, 0.0, small);
  EXPECT_LE(std::fabs(p.tangential), mu * p.normal + small);
  if (std::fabs(u.tangential) > 1e-9) {
    EXPECT_NEAR(p.tangential, -std::copysign(mu * p.normal, u.tangential), small)
        << "sliding is opposed fully";
  }
}

// w = [2 1; 1 3], mu = 1/2: each case with numbers that can be checked by hand.
TEST(LocalLaw, coupled_cases_by_hand) {
  const LocalContact contact = local_contact({2.0, 1.0, 1.0, 3.0}, 0.5);
  ASSERT_TRUE(contact.coupled);
  const auto solved = [&contact](RelativeVelocity b) { return solve_local_contact(contact, {}, b); };
  const Impulse open = solved({0.5, -4.0});
  EXPECT_EQ(open.normal, 0.0);
  EXPECT_EQ(open.tangential, 0.0);
  // Stick: w (2, -1/2) = (3.5, 0.5).
  const Impulse stick = solved({-3.5, -0.5});
  EXPECT_NEAR(stick.normal, 2.0, 1e-15);
  EXPECT_NEAR(stick.tangential, -0.5, 1e-15);
  // Slide to -t: P = (2, 1), U_n = -5 + 4 + 1 = 0, U_t = -9 + 2 + 3 = -4.
  const Impulse backward = solved({-5.0, -9.0});
  EXPECT_NEAR(backward.normal, 2.0, 1e-15);
  EXPECT_NEAR(backward.tangential, 1.0, 1e-15);
  // Slide to +t: P = (2, -1), U_n = -3 + 4 - 1 = 0, U_t = 9 + 2 - 3 = 8.
  const Impulse forward = solved({-3.0, 9.0});
  EXPECT_NEAR(forward.normal, 2.0, 1e-15);
  EXPECT_NEAR(forward.tangential, -1.0, 1e-15);
}

// A unique solution is found from any initial impulse of the contact.
TEST(LocalLaw, random_coupled_contacts_obey_the_law) {
  Random random(4);
  int carrying = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    DelassusBlock w{random.uniform(0.5, 2.0), 0.0, 0.0, random.uniform(0.5, 2.0)};
    w.nt = w.tn = random.uniform(-0.49, 0.49);  // positive definite, and mu |w_nt| < w_nn
    const double mu = random.uniform(0.0, 1.0);
    const RelativeVelocity b{random.uniform(-1.0, 0.5), random.uniform(-1.0, 1.0)};
    const LocalContact contact = local_contact(w, mu);
    const Impulse p = solve_local_contact(contact, {}, b);
    expect_lawful(p, after(w, p, b), mu);
    const Impulse before{random.uniform(0.0, 1.0), random.uniform(-1.0, 1.0)};
    const Impulse again = solve_local_contact(contact, before, after(w, before, b));
    EXPECT_NEAR(again.normal, p.normal, 1e-12);
    EXPECT_NEAR(again.tangential, p.tangential, 1e-12);
    if (p.normal > 0.0) ++carrying;
  }
  EXPECT_GT(carrying, 1000);
}

TEST(LocalLaw, coupling_of_round_off_counts_as_none) {
  EXPECT_FALSE(local_contact({1.0, 1e-16, -1e-16, 3.0}, 0.5).coupled);
  EXPECT_TRUE(local_contact({1.0, 1e-9, 0.0, 3.0}, 0.5).coupled);
}

// Between two immobile bodies any impulse is a solution and stays unchanged.
TEST(LocalLaw, a_contact_that_nothing_moves_keeps_its_impulse) {
  const Impulse p = solve_local_contact(local_contact({}, 0.5), {2.0, 0.5}, {-1.0, 1.0});
  EXPECT_EQ(p.normal, 2.0);
  EXPECT_EQ(p.tangential, 0.5);
}

// For such strong friction and coupling no case fits; the result is still an admissible impulse.
TEST(LocalLaw, without_a_solution_the_impulse_is_admissible) {
  const LocalContact contact = local_contact({1.0, -2.0, -2.0, 1.0}, 3.0);
  for (double bt : {-1.0, 0.0, 1.0}) {
    const Impulse p = solve_local_contact(contact, {}, {-1.0, bt});
    EXPECT_TRUE(std::isfinite(p.normal) && std::isfinite(p.tangential));
    EXPECT_GE(p.normal, 0.0);
    EXPECT_LE(std::fabs(p.tangential), 3.0 * p.normal);
  }
}

TEST(LocalLaw, residual_is_that_of_the_bodies) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const ContactProblem problem = test::random_problem(seed, 12, 25);
    ContactSolution solution = test::no_guess(problem);
    Random random(seed);
    for (double& pn : solution.pn) pn = random.uniform(0.0, 1.0);
    velocities_from_impulses(problem, solution);
    const Residual expected = natural_map_residual(problem, solution);
    const Residual found = natural_map_residual(local_problem(problem), local_form(problem, solution));
    EXPECT_GT(expected.eta, 0.01);
    EXPECT_NEAR(found.eta, expected.eta, 1e-13);
    EXPECT_NEAR(found.largest, expected.largest, 1e-13);
  }
}

void expect_impulse(const Impulse& p, double normal, double tangential) {
  EXPECT_DOUBLE_EQ(p.normal, normal);
  EXPECT_DOUBLE_EQ(p.tangential, tangential);
}

TEST(ContactLaw, a_contact_that_opens_carries_nothing) {
  expect_impulse(admissible(-1.0, 0.7, 0.5), 0.0, 0.0);
  expect_impulse(admissible(0.0, -0.7, 0.5), 0.0, 0.0);
}

TEST(ContactLaw, inside_the_cone_a_contact_sticks) {
  expect_impulse(admissible(2.0, 0.9, 0.5), 2.0, 0.9);
  expect_impulse(admissible(2.0, -0.9, 0.5), 2.0, -0.9);
  expect_impulse(admissible(2.0, 1.0, 0.5), 2.0, 1.0);
}

// The impulse is projected onto Coulomb's cone along the tangent: sliding must not change the normal impulse.
TEST(ContactLaw, outside_the_cone_it_slides_with_the_same_normal_impulse) {
  expect_impulse(admissible(2.0, 5.0, 0.5), 2.0, 1.0);
  expect_impulse(admissible(2.0, -5.0, 0.5), 2.0, -1.0);
}

TEST(ContactLaw, is_a_projection) {
  for (double pn : {-1.0, 0.0, 0.5, 2.0})
    for (double pt : {-3.0, -0.2, 0.0, 0.2, 3.0}) {
      const Impulse once = admissible(pn, pt, 0.5);
      const Impulse twice = admissible(once.normal, once.tangential, 0.5);
      EXPECT_EQ(once.normal, twice.normal);
      EXPECT_EQ(once.tangential, twice.tangential);
    }
}

// P' = admissible(P - U / W): U_n = -1 m/s at w_n = 2 kg requires 2 N s more.
TEST(ContactLaw, solving_a_contact_stops_the_relative_velocity) {
  expect_impulse(solve_contact(1.0, 0.25, -1.0, -0.5, 2.0, 0.5, 0.5), 3.0, 0.5);
  expect_impulse(solve_contact(1.0, 0.25, 1.0, -0.5, 2.0, 0.5, 0.5), 0.0, 0.0);
  expect_impulse(solve_contact(1.0, 0.0, 0.0, 4.0, 2.0, 0.5, 0.5), 1.0, -0.5);
}

}  // namespace
}  // namespace talus::solver
