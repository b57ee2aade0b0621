#include "contact/detection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/scenes.h"

namespace talus::contact {
namespace {

using test::density;
using test::radius;

Contacts detect(const World& world, double margin) {
  NeighbourList list;
  Contacts contacts;
  detect_contacts(list, world.grains, world.boundary, margin, contacts);
  return contacts;
}

TEST(Detection, the_normal_points_from_the_lower_to_the_higher_id) {
  World world;
  add_disk(world.grains, {0.0, 0.0}, 1.0, density, false);
  add_disk(world.grains, {-1.5, 2.0}, 1.4, density, false);  // 3-4-5: distance 2.5, gap 0.1
  const Contacts contacts = detect(world, 0.2);
  ASSERT_EQ(contacts.count(), 1);
  EXPECT_EQ(contacts.a[0], 0);
  EXPECT_EQ(contacts.b[0], 1);
  EXPECT_DOUBLE_EQ(contacts.nx[0], -0.6);
  EXPECT_DOUBLE_EQ(contacts.ny[0], 0.8);
  EXPECT_NEAR(contacts.gap[0], 0.1, 1e-15);
}

TEST(Detection, an_overlap_is_a_negative_gap) {
  World world;
  add_disk(world.grains, {0.0, 0.0}, 1.0, density, false);
  add_disk(world.grains, {1.75, 0.0}, 1.0, density, false);
  const Contacts contacts = detect(world, 0.0);
  ASSERT_EQ(contacts.count(), 1);
  EXPECT_DOUBLE_EQ(contacts.gap[0], -0.25);
}

// At a plane, n points from the grain into the plane, opposite to the plane's inward normal.
TEST(Detection, planes_come_after_the_grains_and_their_normal_points_into_them) {
  World world;
  world.boundary.length = 10.0;
  world.boundary.planes = {{{1.0, 0.0}, 0.0}, {{-1.0, 0.0}, -10.0}, {{0.0, 1.0}, 0.5, false}};
  add_disk(world.grains, {1.25, 1.75}, 1.0, density, false);
  add_disk(world.grains, {8.5, 5.0}, 1.0, density, false);
  add_disk(world.grains, {5.0, -0.5}, 1.0, density, true);
  const Contacts contacts = detect(world, 1.0);
  ASSERT_EQ(contacts.count(), 3);
  EXPECT_EQ(contacts.a, (std::vector<Index>{0, 0, 1}));
  EXPECT_EQ(contacts.b, (std::vector<Index>{3, 5, 4}));
  EXPECT_EQ(contacts.nx, (std::vector<double>{-1.0, 0.0, 1.0}));
  EXPECT_EQ(contacts.ny, (std::vector<double>{0.0, -1.0, 0.0}));
  EXPECT_EQ(contacts.gap, (std::vector<double>{0.25, 0.25, 0.5}));
}

// a touches b + shift * length, for both orders of a pair across the edge.
TEST(Detection, the_shift_brings_b_next_to_a) {
  for (const bool first_left : {true, false}) {
    World world;
    world.boundary.periodic = true;
    world.boundary.length = 20.0;
    add_disk(world.grains, {first_left ? 0.5 : 19.0, 1.0}, 1.0, density, false);
    add_disk(world.grains, {first_left ? 19.0 : 0.5, 1.0}, 1.0, density, false);
    const Contacts contacts = detect(world, 0.1);
    ASSERT_EQ(contacts.count(), 1);
    EXPECT_EQ(contacts.shift[0], first_left ? -1 : 1);
    EXPECT_DOUBLE_EQ(contacts.nx[0], first_left ? -1.0 : 1.0);
    EXPECT_DOUBLE_EQ(contacts.gap[0], -0.5);
  }
}

TEST(Detection, the_margin_is_not_reached) {
  World world;
  add_disk(world.grains, {0.0, 0.0}, 1.0, density, false);
  add_disk(world.grains, {2.25, 0.0}, 1.0, density, false);
  EXPECT_EQ(detect(world, 0.25).count(), 0);
  EXPECT_EQ(detect(world, 0.25 + 1e-15).count(), 1);
}

TEST(Detection, normals_are_unit_and_lead_to_the_other_centre) {
  const World world = test::random_cloud(4, 120, true, 12.0 * radius);
  const Contacts contacts = detect(world, 0.1 * radius);
  const Grains& g = world.grains;
  ASSERT_GT(contacts.count(), 100);
  for (Index c = 0; c < contacts.count(); ++c) {
    EXPECT_NEAR(std::hypot(contacts.nx[c], contacts.ny[c]), 1.0, 1e-15);
    const Index a = contacts.a[c];
    const Index b = contacts.b[c];
    const double distance = g.radius[a] + g.radius[b] + contacts.gap[c];
    EXPECT_NEAR(g.x[a] + distance * contacts.nx[c], g.x[b] + contacts.shift[c] * world.boundary.length,
                1e-15);
    EXPECT_NEAR(g.y[a] + distance * contacts.ny[c], g.y[b], 1e-15);
  }
}

// More candidates than are processed at once, with planes among them.
TEST(Detection, a_team_finds_the_contacts_of_one_thread) {
  World world = test::random_cloud(5, 900, true, 30.0 * radius);
  world.boundary.planes = {{{0.0, 1.0}, 4.0 * radius, false}};
  const Contacts alone = detect(world, 0.1 * radius);
  ASSERT_GT(alone.count(), 1000);
  ASSERT_GT(std::ranges::count(alone.b, world.grains.count()), 10);
  NeighbourList list;
  for (const int size : {1, 2, 3, 5}) {
    ThreadTeam team(size);
    Contacts contacts;
    detect_contacts(list, world.grains, world.boundary, 0.1 * radius, contacts, &team);
    EXPECT_EQ(contacts.a, alone.a) << size;
    EXPECT_EQ(contacts.b, alone.b) << size;
    EXPECT_EQ(contacts.shift, alone.shift) << size;
    EXPECT_EQ(contacts.nx, alone.nx) << size;
    EXPECT_EQ(contacts.ny, alone.ny) << size;
    EXPECT_EQ(contacts.gap, alone.gap) << size;
  }
}

TEST(Detection, coincident_centres_are_pushed_apart_upwards) {
  World world;
  add_disk(world.grains, {0.3, 0.3}, 1.0, density, false);
  add_disk(world.grains, {0.3, 0.3}, 1.0, density, false);
  const Contacts contacts = detect(world, 0.0);
  ASSERT_EQ(contacts.count(), 1);
  EXPECT_EQ(contacts.nx[0], 0.0);
  EXPECT_EQ(contacts.ny[0], 1.0);
  EXPECT_EQ(contacts.gap[0], -2.0);
}

}  // namespace
}  // namespace talus::contact
