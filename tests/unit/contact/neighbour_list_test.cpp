#include "contact/neighbour_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "contact/detection.h"
#include "core/random.h"
#include "support/scenes.h"

namespace talus::contact {
namespace {

using test::radius;
using Key = std::tuple<Index, Index, int>;

/// Returns all pairs with a gap below `margin`, sorted, found by testing every pair through every image.
std::vector<Key> brute_force(const Grains& grains, const Boundary& boundary, double margin) {
  std::vector<Key> keys;
  for (Index a = 0; a < grains.free_count; ++a) {
    for (Index b = a + 1; b < grains.count(); ++b)
      for (int shift = boundary.periodic ? -1 : 0; shift <= (boundary.periodic ? 1 : 0); ++shift) {
        const double dx = grains.x[b] + shift * boundary.length - grains.x[a];
        const double dy = grains.y[b] - grains.y[a];
        if (std::hypot(dx, dy) - grains.radius[a] - grains.radius[b] < margin) keys.emplace_back(a, b, shift);
      }
    for (std::size_t k = 0; k < boundary.planes.size(); ++k) {
      const Plane& plane = boundary.planes[k];
      const double height = plane.normal.x * grains.x[a] + plane.normal.y * grains.y[a] - plane.offset;
      if (height - grains.radius[a] < margin) keys.emplace_back(a, grains.count() + static_cast<Index>(k), 0);
    }
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

std::vector<Key> keys_of(const Contacts& contacts) {
  std::vector<Key> keys;
  for (Index c = 0; c < contacts.count(); ++c)
    keys.emplace_back(contacts.a[c], contacts.b[c], contacts.shift[c]);
  return keys;
}

/// Returns a cloud with glued grains below it and, if it is not periodic, walls and a plane.
World crowded_world(std::uint64_t seed, bool periodic, double length, Index count = 80) {
  World world = test::random_cloud(seed, count, periodic, length);
  for (double x = radius; x < length; x += 2.0 * radius)
    add_disk(world.grains, {x, -radius}, radius, test::density, true);
  if (!periodic) {
    world.boundary.planes = {{{1.0, 0.0}, 0.0}, {{-1.0, 0.0}, -length}, {{0.6, 0.8}, 0.3 * length, false}};
  }
  return world;
}

/// Moves the free grains with their velocities, up to 1 m/s in each direction, and keeps x in the period.
void drift(World& world, double duration) {
  Grains& grains = world.grains;
  for (Index i = 0; i < grains.free_count; ++i) {
    grains.x[i] += duration * grains.vx[i];
    grains.y[i] += duration * grains.vy[i];
    if (world.boundary.periodic)
      grains.x[i] -= std::floor(grains.x[i] / world.boundary.length) * world.boundary.length;
  }
}

void expect_same(const Contacts& found, const Contacts& expected) {
  EXPECT_EQ(keys_of(found), keys_of(expected));
  EXPECT_EQ(found.nx, expected.nx);
  EXPECT_EQ(found.ny, expected.ny);
  EXPECT_EQ(found.gap, expected.gap);
}

/// Uses one list through many small moves, a large one, and a change of the margin. It finds what brute force
/// finds, bit-identical to a list made from scratch, with or without a team.
void compare_lists(bool periodic, double length, Index count) {
  ThreadTeam team(3);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    World world = crowded_world(seed, periodic, length, count);
    NeighbourList list;
    for (int round = 0; round < 30; ++round) {
      const double margin = round == 5 ? 0.8 * radius : 0.05 * radius;
      Contacts through_aged, through_fresh;
      NeighbourList fresh;
      detect_contacts(list, world.grains, world.boundary, margin, through_aged);
      detect_contacts(fresh, world.grains, world.boundary, margin, through_fresh,
                      round % 2 ? &team : nullptr);
      EXPECT_EQ(keys_of(through_aged), brute_force(world.grains, world.boundary, margin))
          << "seed " << seed << ", round " << round;
      expect_same(through_aged, through_fresh);
      drift(world, round == 7 ? radius : 0.015 * radius);
    }
    EXPECT_LT(list.rebuilds, 30) << "the list was never used twice";
    EXPECT_GT(list.rebuilds, 5) << "the list never aged";
  }
}

TEST(NeighbourList, finds_what_brute_force_finds_between_walls) { compare_lists(false, 14.0 * radius, 80); }

TEST(NeighbourList, finds_what_brute_force_finds_in_a_periodic_bed) {
  compare_lists(true, 14.0 * radius, 80);
}

// With fewer than three columns of cells, a grain meets its neighbours through several images.
TEST(NeighbourList, finds_all_images_in_short_periodic_beds) {
  for (double length : {3.0, 4.5, 6.0, 7.5, 9.0}) compare_lists(true, length * radius, 20);
}

TEST(NeighbourList, is_kept_while_no_grain_moved_by_half_the_skin) {
  World world = crowded_world(1, true, 14.0 * radius);
  NeighbourList list;
  update_neighbour_list(list, world.grains, world.boundary, 0.1 * radius);
  ASSERT_EQ(list.rebuilds, 1);
  world.grains.y[7] += 0.49 * list.skin;
  update_neighbour_list(list, world.grains, world.boundary, 0.1 * radius);
  EXPECT_EQ(list.rebuilds, 1);
  EXPECT_EQ(list.renewals, 0);
  world.grains.y[7] += 0.02 * list.skin;
  for (int again = 0; again < 2; ++again) {
    update_neighbour_list(list, world.grains, world.boundary, 0.1 * radius);
    EXPECT_EQ(list.rebuilds, 1);
    EXPECT_EQ(list.renewals, 1) << "for one grain";
  }
}

TEST(NeighbourList, is_made_anew_where_it_does_not_reach_far_enough_or_too_far) {
  World world = crowded_world(1, true, 14.0 * radius);
  NeighbourList list;
  std::int64_t rebuilds = 0;
  for (const double reach : {0.1, 0.2, 0.01}) {
    update_neighbour_list(list, world.grains, world.boundary, reach * radius);
    EXPECT_EQ(list.rebuilds, ++rebuilds) << reach;
    EXPECT_EQ(list.reach, reach * radius);
  }
  update_neighbour_list(list, world.grains, world.boundary, 0.005 * radius);
  EXPECT_EQ(list.rebuilds, rebuilds) << "hardly narrower";
}

TEST(NeighbourList, is_made_anew_for_other_bodies) {
  World world = crowded_world(1, true, 14.0 * radius);
  NeighbourList list;
  update_neighbour_list(list, world.grains, world.boundary, 0.1 * radius);
  add_disk(world.grains, {radius, -radius}, radius, test::density, true);
  update_neighbour_list(list, world.grains, world.boundary, 0.1 * radius);
  EXPECT_EQ(list.rebuilds, 2) << "one more grain, which is not free";
  const Grains none;
  update_neighbour_list(list, none, world.boundary, 0.1 * radius);
  EXPECT_EQ(list.pairs.count(), 0U);
}

TEST(NeighbourList, is_made_anew_where_many_grains_have_moved) {
  World world = crowded_world(1, true, 14.0 * radius);
  NeighbourList list;
  update_neighbour_list(list, world.grains, world.boundary, 0.1 * radius);
  for (Index i = 0; i < world.grains.free_count; ++i) world.grains.y[i] += 0.6 * list.skin;
  update_neighbour_list(list, world.grains, world.boundary, 0.1 * radius);
  EXPECT_EQ(list.rebuilds, 2);
  EXPECT_EQ(list.renewals, 0);
}

/// Adds a free grain at a random place, after the existing ones.
void add_due_grains(World& world, Random& random) {
  Grains& grains = world.grains;
  World alone;
  add_disk(alone.grains, {world.boundary.length * random.uniform(), 14.0 * radius * random.uniform()},
           radius * random.uniform(0.7, 1.0), test::density, false);
  const auto insert = [&grains](auto& to, const auto& from) {
    to.insert(to.begin() + grains.free_count, from.begin(), from.end());
  };
  for (std::vector<double> Grains::*field :
       {&Grains::x, &Grains::y, &Grains::vx, &Grains::vy, &Grains::radius})
    insert(grains.*field, alone.grains.*field);
  ++grains.free_count;
}

// The worst case for two approaching grains: one has just moved; the other had moved away from it by a small
// distance and now returns.
TEST(NeighbourList, sees_a_grain_coming_that_had_moved_the_other_way) {
  for (const bool moved_is_first : {true, false}) {
    World world;
    for (int k = 0; k < 8; ++k)
      add_disk(world.grains, {10.0 * k * radius, 0.0}, radius, test::density, false);
    std::vector<double>& x = world.grains.x;
    const Index moved = moved_is_first ? 2 : 3, other = moved_is_first ? 3 : 2;
    const double side = moved_is_first ? -1.0 : 1.0, reach = 0.1 * radius, at = x[other];
    NeighbourList list;
    Contacts contacts;
    detect_contacts(list, world.grains, world.boundary, reach, contacts);
    x[other] = at - side * 0.24 * list.skin;
    x[moved] = x[other] + side * (2.0 * radius + reach + 1.2 * list.skin);
    detect_contacts(list, world.grains, world.boundary, reach, contacts);
    EXPECT_EQ(list.renewals, 1);
    EXPECT_EQ(contacts.count(), 0);
    x[other] = at + side * 0.49 * list.skin;
    x[moved] -= side * 0.49 * list.skin;
    detect_contacts(list, world.grains, world.boundary, reach, contacts);
    EXPECT_EQ(list.renewals + list.rebuilds, 2);
    EXPECT_EQ(keys_of(contacts), (std::vector<Key>{{2, 3, 0}}));
  }
}

// A few grains are fast, many oscillate within the skin, and one arrives occasionally. The pairs of the few
// are relisted, and the list agrees with one made from scratch and with brute force.
TEST(NeighbourList, lists_the_pairs_of_a_few_grains_anew) {
  for (const bool periodic : {false, true})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      World world = crowded_world(seed, periodic, 30.0 * radius, 200);
      Random random(seed);
      NeighbourList list;
      const double margin = 0.05 * radius;
      for (int round = 0; round < 60; ++round) {
        Contacts through_aged, through_fresh;
        NeighbourList fresh;
        detect_contacts(list, world.grains, world.boundary, margin, through_aged);
        detect_contacts(fresh, world.grains, world.boundary, margin, through_fresh);
        EXPECT_EQ(keys_of(through_aged), brute_force(world.grains, world.boundary, margin))
            << seed << ' ' << round;
        expect_same(through_aged, through_fresh);
        if (round % 3 == 1) add_due_grains(world, random);
        Grains& grains = world.grains;
        for (Index i = 0; i < grains.free_count; ++i) {
          const double way = i % 40 == 0 ? 0.1 * radius
                             : i % 2     ? 0.04 * radius * (round % 2 ? 1.0 : -1.0)
                                         : 0.0;
          grains.x[i] += way;
          if (i % 20 == 10)
            grains.y[i] += (round % 4 < 2 ? 0.04 : -0.04) * radius;  // up to the limit, and beyond
          if (periodic)
            grains.x[i] -= std::floor(grains.x[i] / world.boundary.length) * world.boundary.length;
        }
      }
      EXPECT_GT(list.renewals, 20);
      EXPECT_LT(list.rebuilds, 20);
    }
}

// A grain thrown far above the bed must not make the grid so coarse or so large that pairs are lost.
TEST(NeighbourList, bears_a_grain_far_away) {
  World world = crowded_world(2, false, 14.0 * radius);
  world.grains.y[5] = 1e4;
  world.grains.x[6] = -1e5;
  NeighbourList list;
  Contacts contacts;
  detect_contacts(list, world.grains, world.boundary, 0.1 * radius, contacts);
  EXPECT_EQ(keys_of(contacts), brute_force(world.grains, world.boundary, 0.1 * radius));
  EXPECT_LT(list.cells.start.size(), 10000u);
}

TEST(NeighbourList, a_position_that_is_no_number_has_a_cell_as_all_have) {
  for (const double value : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    for (const bool periodic : {true, false}) {
      World world = test::random_cloud(5, 40, periodic, 1.0);
      world.grains.x[3] = value;
      world.grains.y[7] = value;
      NeighbourList list;
      update_neighbour_list(list, world.grains, world.boundary, 0.1 * radius);
      const auto cells = static_cast<Index>(list.cells.start.size()) - 1;
      for (const Index cell : list.cells.grain_cell) EXPECT_TRUE(0 <= cell && cell < cells) << cell;
      std::vector<Index> grains = list.cells.grain;
      std::sort(grains.begin(), grains.end());
      for (Index i = 0; i < world.grains.count(); ++i) EXPECT_EQ(grains[i], i);
    }
}

}  // namespace
}  // namespace talus::contact
