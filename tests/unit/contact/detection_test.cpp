///

#include "contact/detection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/random.h"
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

using Pairs = std::vector<std::pair<Index, Index>>;

/// Returns contacts of the given pairs; contact c has the forces (c + 1, -c - 1).
Contacts contacts_of(const Pairs& pairs) {
  Contacts contacts;
  contacts.resize(pairs.size());
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    contacts.a[c] = pairs[c].first;
    contacts.b[c] = pairs[c].second;
    contacts.fn[c] = static_cast<double>(c) + 1.0;
    contacts.ft[c] = -contacts.fn[c];
  }
  return contacts;
}

TEST(Memory, merges_what_stayed_and_forgets_what_went) {
  const Contacts previous = contacts_of({{0, 1}, {0, 4}, {2, 3}, {2, 5}, {7, 9}});
  Contacts contacts = contacts_of({{0, 2}, {0, 4}, {1, 3}, {2, 3}, {2, 4}, {2, 5}, {8, 9}});
  recall_forces(previous, contacts);
  EXPECT_EQ(contacts.fn, (std::vector<double>{0, 2, 0, 3, 0, 4, 0}));
  EXPECT_EQ(contacts.ft, (std::vector<double>{0, -2, 0, -3, 0, -4, 0}));
}

TEST(Memory, of_nothing_is_nothing) {
  Contacts contacts = contacts_of({{0, 1}, {1, 2}});
  recall_forces({}, contacts);
  EXPECT_EQ(contacts.fn, (std::vector<double>{0, 0}));
  Contacts none;
  recall_forces(contacts_of({{0, 1}}), none);
  EXPECT_EQ(none.count(), 0);
}

// In a bed a few grains long, a pair touches through two images, each with its own force.
TEST(Memory, images_of_one_pair_are_matched_in_their_order) {
  const Contacts previous = contacts_of({{0, 1}, {0, 1}, {0, 2}});
  Contacts both = contacts_of({{0, 1}, {0, 1}, {1, 2}});
  recall_forces(previous, both);
  EXPECT_EQ(both.fn, (std::vector<double>{1, 2, 0}));
  Contacts one = contacts_of({{0, 1}, {0, 2}});
  recall_forces(previous, one);
  EXPECT_EQ(one.fn, (std::vector<double>{1, 3}));
}

// Parts may begin anywhere, also between the images of a pair.
TEST(Memory, of_a_team_is_that_of_one_thread) {
  Random random(7);
  for (int round = 0; round < 50; ++round) {
    Pairs before, after;
    for (Index a = 0; a < 6; ++a)
      for (Index b = a + 1; b < 8; ++b)
        for (int image = 0; image < 3; ++image) {
          if (random.uniform() < 0.4) before.emplace_back(a, b);
          if (random.uniform() < 0.4) after.emplace_back(a, b);
        }
    const Contacts previous = contacts_of(before);
    Contacts alone = contacts_of(after);
    recall_forces(previous, alone);
    for (const int size : {1, 2, 3, 5}) {
      ThreadTeam team(size);
      Contacts together = contacts_of(after);
      recall_forces(previous, together, &team);
      EXPECT_EQ(together.fn, alone.fn) << size;
      EXPECT_EQ(together.ft, alone.ft) << size;
    }
  }
}

TEST(Memory, of_random_sets_is_a_lookup_by_pair) {
  Random random(5);
  for (int round = 0; round < 20; ++round) {
    Pairs before, after;
    for (Index a = 0; a < 20; ++a)
      for (Index b = a + 1; b < 20; ++b) {
        if (random.uniform() < 0.2) before.emplace_back(a, b);
        if (random.uniform() < 0.2) after.emplace_back(a, b);
      }
    const Contacts previous = contacts_of(before);
    std::map<std::pair<Index, Index>, double> force;
    for (std::size_t c = 0; c < before.size(); ++c) force[before[c]] = previous.fn[c];
    Contacts contacts = contacts_of(after);
    recall_forces(previous, contacts);
    for (std::size_t c = 0; c < after.size(); ++c) {
      const auto known = force.find(after[c]);
      EXPECT_EQ(contacts.fn[c], known == force.end() ? 0.0 : known->second);
      EXPECT_EQ(contacts.ft[c], -contacts.fn[c]);
    }
  }
}

// A pair across the edge remains the same pair after one grain has wrapped.
TEST(Memory, a_grain_that_wraps_around_the_edge_keeps_its_forces) {
  World world;
  world.boundary.periodic = true;
  world.boundary.length = 20.0;
  add_disk(world.grains, {19.5, 1.0}, 1.0, test::density, false);
  add_disk(world.grains, {1.5, 1.0}, 1.0, test::density, false);
  add_disk(world.grains, {17.5, 1.0}, 1.0, test::density, false);
  NeighbourList list;
  Contacts before, after;
  detect_contacts(list, world.grains, world.boundary, 0.1, before);
  ASSERT_EQ(before.count(), 2);
  before.fn = {3.0, 5.0};
  before.ft = {0.5, -0.25};
  world.grains.x[0] += 0.75 - world.boundary.length;
  world.grains.x[1] += 0.75;
  world.grains.x[2] += 0.75;
  detect_contacts(list, world.grains, world.boundary, 0.1, after);
  ASSERT_EQ(after.count(), 2);
  EXPECT_EQ(before.shift, (std::vector<std::int8_t>{1, 0}));
  EXPECT_EQ(after.shift, (std::vector<std::int8_t>{0, -1}));
  recall_forces(before, after);
  EXPECT_EQ(after.fn, before.fn);
  EXPECT_EQ(after.ft, before.ft);
}

}  // namespace
}  // namespace talus::contact
