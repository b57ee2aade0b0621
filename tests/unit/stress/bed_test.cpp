#include "stress/bed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/trigonometry.h"
#include "unit/stress/beds.h"

namespace talus::stress {
namespace {

using test::add_grain;
using test::empty_bed;

TEST(Bed, area_and_height_are_those_of_the_free_grains) {
  World world = empty_bed(10.0, true);
  add_grain(world, 1.0, 1.0, 1.0);
  add_grain(world, 4.0, 6.0, 2.0);
  add_grain(world, 7.0, 100.0, 3.0, true);
  EXPECT_DOUBLE_EQ(solid_area(world.grains), 5.0 * pi);
  EXPECT_DOUBLE_EQ(centre_of_mass_height(world.grains), (1.0 * 1.0 + 4.0 * 6.0) / 5.0);
  EXPECT_EQ(centre_of_mass_height({}), 0.0);
}

TEST(ContactStatus, tells_open_sticking_and_sliding_apart) {
  EXPECT_EQ(contact_status(0.0, 0.0, 0.5), ContactStatus::open);
  EXPECT_EQ(contact_status(2.0, 0.9, 0.5), ContactStatus::sticking);
  EXPECT_EQ(contact_status(2.0, 1.0, 0.5), ContactStatus::sliding);
  EXPECT_EQ(contact_status(2.0, -1.0, 0.5), ContactStatus::sliding);
  EXPECT_EQ(contact_status(2.0, 0.0, 0.0), ContactStatus::sliding);  // no friction remains to be mobilised
}

TEST(ContactStatus, sliding_is_judged_within_the_tolerance) {
  EXPECT_EQ(contact_status(2.0, 1.0 - 1.9e-6, 0.5), ContactStatus::sliding);
  EXPECT_EQ(contact_status(2.0, 1.0 - 2.1e-6, 0.5), ContactStatus::sticking);
  EXPECT_EQ(contact_status(2.0, 0.95, 0.5, 0.03), ContactStatus::sliding);
}

// Grains 0, 1, 2 are free, 3 is a rattler, 4 is glued, 5 is a plane. Ends at free grains: 0-1 has two, 1-4
// and 2-5 have one each.
TEST(CoordinationNumber, counts_each_contact_for_each_free_grain_it_touches) {
  const std::vector<Index> a = {0, 1, 2}, b = {1, 4, 5};
  EXPECT_EQ(contacts_of_grains(a, b, 4), (std::vector<Index>{1, 2, 1, 0}));
  EXPECT_DOUBLE_EQ(coordination_number(contacts_of_grains(a, b, 4)), 4.0 / 3.0);
  EXPECT_EQ(coordination_number(contacts_of_grains({}, {}, 4)), 0.0);
}

}  // namespace
}  // namespace talus::stress
