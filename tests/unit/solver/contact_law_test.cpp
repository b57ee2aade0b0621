#include "solver/contact_law.h"

#include <gtest/gtest.h>

namespace talus::solver {
namespace {

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

TEST(ContactLaw, without_friction_there_is_no_tangential_impulse) {
  expect_impulse(admissible(2.0, 5.0, 0.0), 2.0, 0.0);
  expect_impulse(admissible(2.0, -5.0, 0.0), 2.0, 0.0);
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
