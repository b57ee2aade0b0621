#include "analysis/packing/local_solid_fraction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "core/trigonometry.h"
#include "unit/analysis/packings.h"

namespace talus::analysis {
namespace {

using test::Packing;

/// Returns disks of radius 0.3 to 0.6, placed at random without overlaps until no further ones fit, so that
/// cells are open only at the upper and lower ends.
Packing random_disks(bool periodic) {
  constexpr double length = 12.0, height = 9.0;
  Random random(11);
  Packing packing = test::empty_packing(length, periodic);
  for (int trial = 0; trial < 40000; ++trial) {
    const double r = random.uniform(0.3, 0.6);
    const double x = periodic ? random.uniform(0.0, length) : random.uniform(r, length - r);
    const double y = random.uniform(r, height - r);
    bool free = true;
    for (std::size_t i = 0; i < packing.frame.x.size() && free; ++i) {
      double dx = std::fabs(packing.frame.x[i] - x);
      if (periodic) dx = std::min(dx, length - dx);
      free = std::hypot(dx, packing.frame.y[i] - y) >= packing.statics.radius[i] + r;
    }
    if (free) test::add_grain(packing, x, y, r);
  }
  return packing;
}

/// Returns the areas in which each grain has the smallest power, up to the largest value, from a grid of
/// points in the bed.
std::vector<double> areas_by_points(const Packing& packing, double spacing) {
  const std::size_t count = packing.frame.x.size();
  const double length = packing.statics.length;
  std::vector<double> areas(count, 0.0);
  for (double x = 0.5 * spacing; x < length; x += spacing)
    for (double y = 0.5 * spacing; y < 12.0; y += spacing) {
      std::size_t nearest = 0;
      double least = 1e9;
      for (std::size_t i = 0; i < count; ++i) {
        double dx = std::fabs(packing.frame.x[i] - x);
        if (packing.statics.periodic) dx = std::min(dx, length - dx);
        const double dy = packing.frame.y[i] - y, r = packing.statics.radius[i];
        const double power = dx * dx + dy * dy - r * r;
        if (power < least) {
          least = power;
          nearest = i;
        }
      }
      if (least <= largest_power) areas[nearest] += spacing * spacing;
    }
  return areas;
}

// Every point belongs to exactly one grain, so cells with these areas tile the bed.
TEST(GrainCells, tile_the_bed) {
  for (const bool periodic : {true, false}) {
    const Packing packing = random_disks(periodic);
    const std::vector<GrainCell> cells = grain_cells(packing);
    const std::vector<double> areas = areas_by_points(packing, 0.03);
    int closed = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i].is_open) continue;
      ++closed;
      EXPECT_NEAR(cells[i].area(), areas[i], 0.03) << i;
    }
    EXPECT_GT(closed, 60) << cells.size();
  }
}

TEST(GrainCells, cut_no_disk) {
  const Packing packing = random_disks(true);
  const std::vector<GrainCell> cells = grain_cells(packing);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::vector<Vec2>& corners = cells[i].corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec2 &a = corners[k], &b = corners[(k + 1) % corners.size()];
      const double x = packing.frame.x[i], y = packing.frame.y[i];
      const double distance =
          ((a.x - x) * (b.y - y) - (b.x - x) * (a.y - y)) / std::hypot(b.x - a.x, b.y - a.y);
      EXPECT_GE(distance, packing.statics.radius[i] - 1e-12) << "counter-clockwise, outside the disk";
    }
  }
}

TEST(LocalSolidFraction, of_a_triangular_lattice) {
  const Packing packing = test::triangular_lattice(10, 8, true);
  const std::vector<double> fractions = local_solid_fractions(packing);
  for (std::size_t i = 10; i < 70; ++i) EXPECT_NEAR(fractions[i], pi / (2.0 * std::numbers::sqrt3), 1e-12);
  for (std::size_t i = 70; i < 80; ++i) EXPECT_TRUE(std::isnan(fractions[i])) << "at the free surface";
  // The lowest row lies on a smooth floor, so one corner less is cut off.
  EXPECT_NEAR(fractions[0], 0.25 * pi / (0.5 + 0.25 * std::numbers::sqrt3), 1e-12);
  FrameRecord record;
  measure_local_solid_fraction(packing, record);
  const double inner = pi / (2.0 * std::numbers::sqrt3), lowest = fractions[0];
  EXPECT_NEAR(record.local_solid_fraction, (6.0 * inner + lowest) / 7.0, 1e-12);
  EXPECT_NEAR(record.local_solid_fraction_spread, (inner - lowest) * std::sqrt(6.0) / 7.0, 1e-12);
}

// Alternating large and small disks on a square lattice, each touching four of the other size. The cell of a
// small disk is its circumscribed square; that of a large one is a square whose corners are cut off at half
// the diagonal.
TEST(LocalSolidFraction, of_two_sizes_by_hand) {
  constexpr double large = 0.6, small = 0.4;
  Packing packing = test::empty_packing(8.0, true);
  for (int row = 0; row < 8; ++row)
    for (int column = 0; column < 8; ++column)
      test::add_grain(packing, column + 0.25, row + large, (row + column) % 2 == 0 ? large : small);
  const std::vector<GrainCell> cells = grain_cells(packing);
  const std::size_t of_large = 8 * 4 + 4, of_small = 8 * 4 + 3;
  EXPECT_NEAR(cells[of_small].area(), 4.0 * small * small, 1e-12);
  EXPECT_NEAR(cells[of_large].area(), 4.0 * large * large - 2.0 * (large - small) * (large - small), 1e-12);
  EXPECT_EQ(cells[of_large].corners.size(), 8u);
  EXPECT_NEAR(local_solid_fractions(packing)[of_small], pi / 4.0, 1e-12);
}

// A grain in a box of two walls, a smooth floor, and a neighbour above that covers its full width.
TEST(LocalSolidFraction, walls_and_floor_are_edges) {
  Packing packing = test::empty_packing(1.25, false);
  test::add_grain(packing, 0.625, 0.5);
  test::add_grain(packing, 0.625, 1.75);
  EXPECT_NEAR(grain_cells(packing)[0].area(), 1.25 * 1.125, 1e-12);
  test::add_floor_grain(packing, 0.625, -0.75);  // replaces the smooth floor
  EXPECT_NEAR(grain_cells(packing)[0].area(), 1.25 * 1.25, 1e-12);
}

TEST(LocalSolidFraction, of_a_grain_by_itself_is_not_known) {
  Packing packing = test::empty_packing(20.0, false);
  test::add_grain(packing, 5.0, 5.0);
  EXPECT_TRUE(std::isnan(local_solid_fractions(packing)[0]));
  EXPECT_TRUE(local_solid_fractions(test::empty_packing(20.0, false)).empty());
}

// A ring of six disks encloses a hole of the largest power; the hole of a wider ring is not part of the bed.
TEST(LocalSolidFraction, holes_count_as_far_as_a_ring_of_six_has_them) {
  for (const auto& [ring, open] : {std::pair(6, false), {7, true}}) {
    Packing packing = test::empty_packing(40.0, false);
    const double radius = 0.5 / std::sin(pi / ring);
    for (int shell = 0; shell < 3;
         ++shell)  // outer shells, so that at most the inner one borders on the hole
      for (int k = 0; k < ring + 6 * shell; ++k) {
        const double angle = 2.0 * pi * (k + 0.5 * shell) / (ring + 6 * shell);
        test::add_grain(packing, 20.0 + (radius + 0.95 * shell) * std::cos(angle),
                        20.0 + (radius + 0.95 * shell) * std::sin(angle), 0.5);
      }
    packing.statics.mean_diameter = 1.0 + 1e-9;  // tolerance for the rounding of the ring
    EXPECT_EQ(std::isnan(local_solid_fractions(packing)[0]), open) << ring;
  }
}

}  // namespace
}  // namespace talus::analysis
