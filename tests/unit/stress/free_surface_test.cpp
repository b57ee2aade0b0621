#include "stress/free_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"

namespace talus {
namespace {

constexpr double r = 0.5;
constexpr double spacing = 0.05;

/// Disks side by side from x = 0 to `length`, their tops on the line `height` + `slope` x.
World bed(double length, bool periodic, double height, double slope) {
  World world;
  world.boundary.periodic = periodic;
  world.boundary.length = length;
  for (double x = r; x < length; x += 2.0 * r)
    add_disk(world.grains, {x, height + slope * x - r}, r, 1.0, false);
  return world;
}

double inclination(const World& world) { return surface_inclination(world.grains, world.boundary, spacing); }

TEST(FreeSurface, is_the_envelope_of_the_grains_at_the_middle_of_each_section) {
  World world = bed(0.0, false, 0.0, 0.0);
  world.boundary.length = 4.0;
  add_disk(world.grains, {1.5, 2.0}, 0.4, 1.0, false);
  add_disk(world.grains, {1.4, 1.0}, 0.4, 1.0, false);
  const std::vector<double> height = free_surface(world.grains, world.boundary, 1.0);
  ASSERT_EQ(height.size(), 4u);
  EXPECT_EQ(height[0], 0.0);
  EXPECT_DOUBLE_EQ(height[1], 2.4);
  EXPECT_EQ(height[2], 0.0);
}

/// Sample by sample, each over all disks and their images.
std::vector<double> plain_surface(const World& world, std::size_t samples) {
  const Grains& g = world.grains;
  const double length = world.boundary.length, step = length / static_cast<double>(samples);
  std::vector<double> height(samples, 0.0);
  for (std::size_t k = 0; k < samples; ++k)
    for (Index i = 0; i < g.free_count; ++i)
      for (int image = -2; image <= 2; ++image) {
        if (image != 0 && !world.boundary.periodic) continue;
        const double place = static_cast<double>(k) + image * static_cast<double>(samples);
        const double offset = (place + 0.5) * step - g.x[i];
        const double square = g.radius[i] * g.radius[i] - offset * offset;
        if (square >= 0.0) height[k] = std::max(height[k], g.y[i] + std::sqrt(square));
      }
  return height;
}

TEST(FreeSurface, is_that_of_all_disks_sample_by_sample) {
  Random random(7);
  for (const bool periodic : {false, true})
    for (const int samples : {1, 15, 16, 40, 331}) {
      World world;
      world.boundary.periodic = periodic;
      world.boundary.length = 7.0;
      for (int k = 0; k < 40; ++k)
        add_disk(world.grains, {7.0 * random.uniform(), 3.0 * random.uniform()}, 0.1 + random.uniform(), 1.0,
                 false);
      add_disk(world.grains, {6.9, 2.0}, 4.0, 1.0, false);  // wider than the bed
      const std::vector<double> height = free_surface(world.grains, world.boundary, 7.0 / samples);
      const std::vector<double> plain = plain_surface(world, height.size());
      for (std::size_t k = 0; k < height.size(); ++k) EXPECT_EQ(height[k], plain[k]) << samples << ' ' << k;
    }
}

// n = 20 bumps lie in the middle half. Each is symmetric about its grain, so what is fitted is a staircase of
// n steps, and that is less steep than its line by 1/n^2.
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
  EXPECT_EQ(inclination(world), straight) << "what is piled up at the walls";
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
}  // namespace talus
