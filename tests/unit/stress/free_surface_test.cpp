#include "stress/free_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "core/trigonometry.h"
#include "unit/stress/beds.h"

namespace talus::stress {
namespace {

using test::add_grain;
using test::empty_bed;

constexpr double r = test::unit_radius;

/// Returns adjacent disks from x = 0 to `length`, with their tops on the line `height` + `slope` x.
World bed(double length, bool periodic, double height, double slope) {
  World world;
  world.boundary.periodic = periodic;
  world.boundary.length = length;
  for (double x = r; x < length; x += 2.0 * r)
    add_disk(world.grains, {x, height + slope * x - r}, r, 1.0, false);
  return world;
}

double inclination(const World& world) { return surface_inclination(world.grains, world.boundary); }

double volume(const World& world) { return bed_volume(world.grains, world.boundary); }

/// Returns the free surface at the middle of each of the equal sections of a bed, over all disks and their
/// images.
std::vector<double> plain_surface(const World& world, std::size_t samples) {
  const Grains& g = world.grains;
  const double length = world.boundary.length, step = length / static_cast<double>(samples);
  std::vector<double> height(samples, 0.0);
  for (Index i = 0; i < g.free_count; ++i)
    for (int image = -6; image <= 6; ++image) {
      if (image != 0 && !world.boundary.periodic) continue;
      const double x = g.x[i] + image * length;
      const double first = std::max(0.0, std::floor((x - g.radius[i]) / step));
      for (auto k = static_cast<std::size_t>(first); k < samples; ++k) {
        const double offset = (static_cast<double>(k) + 0.5) * step - x;
        if (offset > g.radius[i]) break;
        const double square = g.radius[i] * g.radius[i] - offset * offset;
        if (square >= 0.0) height[k] = std::max(height[k], g.y[i] + std::sqrt(square));
      }
    }
  return height;
}

/// Returns random beds, including some that no scenario gives: overlapping, sparse, wider than long.
World bed_of_chance(Random& random, bool periodic) {
  World world = empty_bed(1.0 + 9.0 * random.uniform(), periodic);
  const double length = world.boundary.length;
  const auto count = 1 + static_cast<int>(60.0 * random.uniform());
  const double largest = random.uniform() < 0.2 ? 2.0 * length : 0.6;
  const double depth = 4.0 * random.uniform();
  for (int k = 0; k < count; ++k) {
    const double radius = 0.02 + largest * random.uniform() * random.uniform();
    add_grain(world, length * random.uniform(), depth * random.uniform() - 0.3, radius);
  }
  return world;
}

TEST(FreeSurface, is_that_of_all_disks_and_their_images_at_every_place) {
  Random random(7);
  for (int k = 0; k < 400; ++k) {
    const World world = bed_of_chance(random, k % 2 == 0);
    const std::vector<SurfaceArc> surface = free_surface(world.grains, world.boundary);
    constexpr std::size_t samples = 331;
    const std::vector<double> plain = plain_surface(world, samples);
    for (std::size_t s = 0; s < samples; ++s) {
      const double place = (static_cast<double>(s) + 0.5) * world.boundary.length / samples;
      ASSERT_NEAR(height_of(surface, place), plain[s], 2e-7) << "bed " << k << " at " << place;
    }
  }
}

TEST(FreeSurface, ends_in_ascending_order_at_the_length_of_the_bed) {
  Random random(11);
  for (int k = 0; k < 100; ++k) {
    const World world = bed_of_chance(random, k % 2 == 0);
    const std::vector<SurfaceArc> surface = free_surface(world.grains, world.boundary);
    ASSERT_FALSE(surface.empty());
    EXPECT_EQ(surface.back().end, world.boundary.length);
    double begin = 0.0;
    for (const SurfaceArc& arc : surface) {
      EXPECT_GT(arc.end, begin);
      begin = arc.end;
    }
  }
}

/// Returns the area below the surface by the midpoint rule.
double sampled_volume(const World& world, double samples_per_metre) {
  const std::vector<double> heights =
      plain_surface(world, static_cast<std::size_t>(samples_per_metre * world.boundary.length));
  double sum = 0.0;
  for (const double height : heights) sum += height;
  return sum * world.boundary.length / static_cast<double>(heights.size());
}

// A row of touching disks of many sizes, like the surface of a bed: with 10 000 samples per diameter the
// error is 1e-7 of the bed.
TEST(BedVolume, of_a_packing_has_no_error_that_would_hide_its_dilation) {
  World world = empty_bed(0.0, false);
  Random random(9);
  double x = 0.0;
  for (int k = 0; k < 40; ++k) {
    const double radius = 0.2 + 0.6 * random.uniform();
    for (const double depth : {0.0, 1.1}) add_grain(world, x + radius, 20.0 - depth * radius, radius);
    x += 2.0 * radius;
  }
  world.boundary.length = x;
  EXPECT_NEAR(volume(world), sampled_volume(world, 1e4), 3e-7 * 20.0 * x);
}

// Two equal disks at distance d intersect at d/2: each side contributes the integral of sqrt(r^2 - u^2) from
// -r to d/2.
TEST(BedVolume, of_two_disks_that_overlap) {
  World world = empty_bed(10.0, false);
  const double d = 0.6;
  add_grain(world, 4.0, 2.0);
  add_grain(world, 4.0 + d, 2.0);
  const double u = 0.5 * d,
               half = 0.5 * (u * std::sqrt(r * r - u * u) + r * r * (std::asin(u / r) + 0.5 * pi));
  EXPECT_NEAR(volume(world), 2.0 * (2.0 * (r + u) + half), 1e-12);
}

TEST(BedVolume, counts_what_is_above_the_tops_of_the_floor_grains) {
  World world = empty_bed(10.0, true);
  EXPECT_EQ(volume(world), 0.0);
  add_grain(world, 5.0, 2.0);
  EXPECT_NEAR(volume(world), 2.0 * r * (2.0 + 0.25 * pi * r), 1e-12);
  World sunk = empty_bed(10.0, true);
  add_grain(sunk, 5.0, -0.3);
  const double w = std::sqrt(r * r - 0.09);
  EXPECT_NEAR(volume(sunk), w * 0.3 + r * r * std::asin(w / r) - 0.6 * w, 1e-12);
  add_grain(sunk, 8.0, -0.6);
  EXPECT_NEAR(volume(sunk), w * 0.3 + r * r * std::asin(w / r) - 0.6 * w, 1e-12);
}

TEST(BedVolume, only_the_highest_grain_counts_and_only_free_ones) {
  World world = empty_bed(10.0, true);
  add_grain(world, 5.0, 2.0);
  const double alone = volume(world);
  add_grain(world, 5.2, 0.9, 0.2);
  add_grain(world, 5.0, 7.0, r, true);
  add_grain(world, 2.0, -0.5, r, true);
  EXPECT_EQ(volume(world), alone);
}

TEST(BedVolume, reaches_through_the_periodic_edge_and_stops_at_walls) {
  World middle = empty_bed(10.0, true);
  add_grain(middle, 5.0, 2.0);
  World edge = empty_bed(10.0, true);
  add_grain(edge, 0.1, 2.0);
  EXPECT_NEAR(volume(edge), volume(middle), 1e-12);
  World walled = empty_bed(10.0, false);
  add_grain(walled, 0.0, 2.0);
  EXPECT_NEAR(volume(walled), 0.5 * volume(middle), 1e-12);
}

TEST(BedVolume, is_the_sum_of_its_parts) {
  Random random(3);
  const World world = bed_of_chance(random, true);
  const std::vector<SurfaceArc> surface = free_surface(world.grains, world.boundary);
  const double length = world.boundary.length, cut = 0.37 * length;
  EXPECT_NEAR(area_below(surface, 0.0, cut) + area_below(surface, cut, length), volume(world),
              1e-12 * length);
  EXPECT_EQ(area_below(surface, -2.0, -1.0), 0.0);
}

// n = 20 bumps lie in the middle half. Each is symmetric about its grain, so the fit sees a staircase of n
// steps, whose slope is smaller than that of its line by a fraction 1/n^2.
// Touching disks of diameter 1 fill pi / 4 of the square above the lowest line of their tops.
TEST(MeanHeight, is_that_of_the_part_around_a_place) {
  for (const bool periodic : {true, false}) {
    World world = bed(10.0, periodic, 1.0, 0.0);
    const double flat = bed_volume(world.grains, world.boundary) / 10.0;
    for (const double x : {0.5, 1.5, 2.5, 3.5, 4.5}) add_grain(world, x, 4.5);
    const auto height = [&](double centre, double half_width) {
      return mean_height(world.grains, world.boundary, centre, half_width);
    };
    EXPECT_NEAR(height(2.0, 1.0), flat + 4.0, 1e-9) << "the mound";
    EXPECT_NEAR(height(7.0, 1.0), flat, 1e-9) << "the flat part next to it";
    EXPECT_NEAR(height(0.0, 2.0), periodic ? flat + 2.0 : flat + 4.0, 1e-9) << "across the edge, or to it";
    EXPECT_NEAR(height(10.0, 2.0), periodic ? flat + 2.0 : flat, 1e-9);
    EXPECT_NEAR(height(5.0, 50.0), flat + 2.0, 1e-9) << "the whole bed, once";
  }
}

TEST(SurfaceInclination, is_the_slope_of_a_straight_surface) {
  for (const double slope : {0.0, 0.1, 0.3, -0.2})
    EXPECT_NEAR(std::tan(inclination(bed(40.0, false, 20.0, slope))), slope * (1.0 - 1.0 / 400.0),
                1e-3 * std::fabs(slope) + 1e-12)
        << slope;
}

TEST(SurfaceInclination, looks_at_the_middle_half_of_the_bed) {
  World world = bed(40.0, false, 20.0, 0.1);
  const double straight = inclination(world);
  add_disk(world.grains, {2.0, 40.0}, 5.0, 1.0, false);
  add_disk(world.grains, {36.0, 30.0}, 5.0, 1.0, false);
  EXPECT_EQ(inclination(world), straight) << "grains piled up at the walls";
  add_disk(world.grains, {28.0, 30.0}, 1.0, 1.0, false);
  EXPECT_GT(inclination(world), straight + 0.05);
}

TEST(SurfaceInclination, is_nothing_in_a_periodic_bed) {
  EXPECT_EQ(inclination(bed(40.0, true, 20.0, 0.1)), 0.0);
}

TEST(SurfaceInclination, of_no_bed_is_nothing) {
  EXPECT_EQ(inclination(World{}), 0.0);
  World empty;
  empty.boundary.length = 10.0;
  EXPECT_EQ(inclination(empty), 0.0);
}

}  // namespace
}  // namespace talus::stress
