#include "analysis/contacts/weak_contacts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/trigonometry.h"
#include "unit/analysis/packings.h"

namespace talus::analysis {
namespace {

using test::Packing;

/// Grain 0 in the middle, with contacts in the given directions (deg), each with a different grain.
struct Star {
  Packing packing = test::empty_packing(100.0, false);

  Star() { test::add_grain(packing, 0.0, 0.0); }

  void add(double direction, double fn, double mobilised) {
    const Index tip = test::add_grain(packing, cosine(radians(direction)), sine(radians(direction)));
    test::add_contact(packing, 0, tip, fn, mobilised * 0.5 * fn);
  }
};

const std::vector<double> halves = {0.0, 0.5, 1.0};

// Returns a star with two strong contacts at 0 deg; the mean force is 2.5.
Star chain() {
  Star star;
  star.add(0.0, 5.0, 0.1);
  star.add(0.0, 5.0, 0.9);
  return star;
}

TEST(WeakContacts, coherent_ones_across_the_chains_have_negative_fabric) {
  Star star = chain();
  star.add(90.0, 1.0, 0.9);
  star.add(90.0, 1.0, 1.0);
  star.add(45.0, 1.0, 0.1);
  star.add(0.0, 1.0, 0.1);
  const WeakContacts weak = weak_contacts(star.packing, 2.5, halves);
  EXPECT_DOUBLE_EQ(weak.coherent_share, 2.0 / 6.0);
  EXPECT_NEAR(weak.coherent_fabric, -2.0, 1e-15);
  EXPECT_NEAR(weak.incoherent_fabric, 1.0, 1e-15);
  ASSERT_EQ(weak.fabric_by_friction.size(), 2U);
  EXPECT_NEAR(weak.fabric_by_friction[0], 1.0, 1e-15);
  EXPECT_NEAR(weak.fabric_by_friction[1], -2.0, 1e-15);
}

TEST(WeakContacts, friction_counts_without_its_sign_and_from_the_threshold_on) {
  Star star = chain();
  star.add(90.0, 1.0, -0.8);
  star.add(90.0, 1.0, 0.79);
  EXPECT_DOUBLE_EQ(weak_contacts(star.packing, 2.5, halves).coherent_share, 1.0 / 4.0);
}

TEST(WeakContacts, fabric_is_relative_to_the_strong_contacts) {
  Star star;
  star.add(30.0, 5.0, 0.0);
  star.add(-60.0, 1.0, 1.0);
  star.add(75.0, 1.0, 0.0);
  const WeakContacts weak = weak_contacts(star.packing, 2.0, halves);
  EXPECT_NEAR(weak.coherent_fabric, -2.0, 1e-14);
  EXPECT_NEAR(weak.incoherent_fabric, 0.0, 1e-14);
}

TEST(WeakContacts, what_rounding_leaves_above_full_mobilisation_is_in_the_last_bin) {
  Star star = chain();
  star.add(90.0, 1.0, 1.0 + 1e-12);
  EXPECT_NEAR(weak_contacts(star.packing, 2.5, halves).fabric_by_friction[1], -2.0, 1e-15);
}

TEST(WeakContacts, nothing_is_known_without_contacts) {
  const Star star;
  const WeakContacts weak = weak_contacts(star.packing, not_known, halves);
  EXPECT_TRUE(std::isnan(weak.coherent_share));
  EXPECT_TRUE(std::isnan(weak.coherent_fabric));
  EXPECT_TRUE(std::isnan(weak.fabric_by_friction[0]));
}

}  // namespace
}  // namespace talus::analysis
