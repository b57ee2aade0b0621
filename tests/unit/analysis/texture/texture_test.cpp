#include "analysis/texture/texture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/trigonometry.h"
#include "unit/analysis/packings.h"

namespace talus::analysis {
namespace {

using test::Packing;

/// Returns two grains of radius 1/2, then two of radius 3/4; contacts between them have any direction.
Packing two_pairs() {
  Packing packing = test::empty_packing(10.0, false);
  for (const double radius : {0.5, 0.5, 0.75, 0.75}) test::add_grain(packing, 2.0 * radius, 1.0, radius);
  packing.frame.x = {0.0, 1.0, 0.0, 1.0};
  return packing;
}

void add_directed(Packing& packing, Index a, double angle, double fn, double ft = 0.0) {
  test::add_contact(packing, a, a + 1, fn, ft);
  packing.frame.contacts.nx.back() = std::cos(angle);
  packing.frame.contacts.ny.back() = std::sin(angle);
}

// For directions all around, sums of cosines equal the integrals.
TEST(Texture, of_forces_is_what_they_were_made_with) {
  Packing packing = two_pairs();
  const double axis = radians(70.0);
  for (int k = 0; k < 36; ++k) {
    const double angle = radians(5.0 * k);
    add_directed(packing, 0, angle, 2.0 * (1.0 + 0.3 * std::cos(2.0 * (angle - axis))),
                 2.0 * -0.2 * std::sin(2.0 * (angle - axis)));
  }
  const Texture texture = texture_of(packing);
  EXPECT_NEAR(texture.axis, axis, 1e-12);
  EXPECT_NEAR(texture.contacts, 0.0, 1e-12);
  EXPECT_NEAR(texture.normal_forces, 0.3, 1e-12);
  EXPECT_NEAR(texture.tangential_forces, 0.2, 1e-12);
  EXPECT_NEAR(texture.branches, 0.0, 1e-12);
  EXPECT_NEAR(texture.stress_ratio(), 0.25, 1e-12);
}

// Three contacts along the bed, longer than the others; 2 at 45 and at 135 deg, one across. The sum of
// cosines is 2 of 8, that of lengths 3.5 of 9.5. For equal forces this is Gamma.
TEST(Texture, of_contacts_and_lengths) {
  Packing packing = two_pairs();
  for (int k = 0; k < 3; ++k) add_directed(packing, 2, 0.0, 1.0);
  for (const double angle : {45.0, 45.0, 90.0, 135.0, 135.0}) add_directed(packing, 0, radians(angle), 1.0);
  const Texture texture = texture_of(packing);
  EXPECT_NEAR(texture.axis, 0.0, 1e-12);
  EXPECT_NEAR(texture.contacts, 0.5, 1e-12);
  EXPECT_NEAR(texture.normal_forces, 0.0, 1e-12);
  EXPECT_NEAR(texture.tangential_forces, 0.0, 1e-12);
  EXPECT_NEAR(texture.branches, 7.0 / 9.5 - 0.5, 1e-12);
  EXPECT_NEAR(texture.stress_ratio(), 3.5 / 9.5, 1e-12);
}

TEST(Texture, of_no_contacts_is_not_known) {
  EXPECT_TRUE(std::isnan(texture_of(two_pairs()).axis));
  EXPECT_TRUE(std::isnan(texture_of(two_pairs()).stress_ratio()));
}

}  // namespace
}  // namespace talus::analysis
