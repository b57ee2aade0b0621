#include "solver/local_law.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "unit/solver/small_problems.h"

namespace talus::solver {
namespace {

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

}  // namespace
}  // namespace talus::solver
