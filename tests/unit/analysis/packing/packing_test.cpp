///

#include "analysis/packing/packing.h"

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

/// Returns disks of weight 1 and radius 1/2 stacked on a floor grain; the k-th contact from above carries k
/// weights.
Packing stack_of(Index count) {
  Packing packing = test::empty_packing(10.0, false);
  for (Index i = 0; i < count; ++i) test::add_grain(packing, 5.0, 0.5 + i);
  const Index floor = test::add_floor_grain(packing, 5.0, -0.5);
  for (Index i = 0; i + 1 < count; ++i) test::add_contact(packing, i, i + 1, count - 1 - i);
  test::add_contact(packing, 0, floor, count);
  test::moments_from_contacts(packing);
  return packing;
}

FrameRecord stressed(const Packing& packing, double volume) {
  FrameRecord record;
  measure_packing_stress(packing, volume, record);
  return record;
}

// Each disk has M_yy = (force below + force above) / 2, so the sum over n disks is n^2 / 2.
TEST(PackingStress, of_a_stack) {
  const Packing packing = stack_of(4);
  const FrameRecord record = stressed(packing, 2.0);
  EXPECT_NEAR(record.stress[3], 16.0 / 2.0 / 2.0, 1e-15);
  EXPECT_EQ(record.stress[0], 0.0);
  EXPECT_EQ(record.sigma_t_over_n, 0.0);
  EXPECT_EQ(record.stress_ratio, 1.0);
  EXPECT_EQ(packing.frame.gamma[2], 1.0);
}

// From 5 D above the floor to 5 D below the top of a square lattice of touching disks, 1 wide and 20 high.
TEST(BulkSolidFraction, of_a_square_lattice_is_a_quarter_of_pi_whatever_is_cut) {
  Packing packing = test::empty_packing(10.0, true);
  for (Index k = 0; k < 200; ++k) test::add_grain(packing, 0.5 + k % 10, 0.5 + k / 10);
  EXPECT_NEAR(bulk_solid_fraction(packing, 200.0), 0.25 * pi, 1e-12);
  EXPECT_NEAR(bulk_solid_fraction(packing, 193.0), 0.25 * pi, 0.02) << "0.3 of a row is cut off";
  EXPECT_TRUE(std::isnan(bulk_solid_fraction(packing, 100.0))) << "empty range";
}

/// Returns a disk on two others of its size, which it touches at 30 deg to the vertical; they lie on the
/// floor, and `side` holds them from the side.
Packing arch() {
  Packing packing = test::empty_packing(10.0, false);
  const Index left = test::add_grain(packing, 4.5, 0.5);
  const Index right = test::add_grain(packing, 5.5, 0.5);
  const Index top = test::add_grain(packing, 5.0, 0.5 + std::sqrt(0.75));
  const double fn = 0.5 / std::sqrt(0.75);  // for each contact, with a weight of 1
  test::add_contact(packing, left, top, fn);
  test::add_contact(packing, right, top, fn);
  test::moments_from_contacts(packing);
  return packing;
}

// M of the keystone is 2 r fn (sin^2 30, cos^2 30), so gamma = cos 60.
TEST(PackingStress, of_an_arch) {
  const Packing packing = arch();
  EXPECT_NEAR(packing.frame.gamma[2], 0.5, 1e-12);
  const double fn = 0.5 / std::sqrt(0.75);
  const auto [xx, xy, yx, yy] = stressed(packing, 1.0).stress;
  // The two feet together carry as much as the keystone, and their shears cancel.
  EXPECT_NEAR(xx, 2.0 * fn * 0.25, 1e-12);
  EXPECT_NEAR(yy, 2.0 * fn * 0.75, 1e-12);
  EXPECT_NEAR(xy, 0.0, 1e-12);
  EXPECT_NEAR(yx, 0.0, 1e-12);
  EXPECT_NEAR(packing.frame.internal_moment[0].xy, 0.5 * fn * 0.5 * std::sqrt(0.75), 1e-12);
}

TEST(PackingStress, leaves_out_the_floor) {
  Packing packing = stack_of(2);
  packing.frame.internal_moment.back() = {5.0, 0.0, 0.0, 5.0};
  EXPECT_EQ(stressed(packing, 1.0).stress[0], 0.0);
}

TEST(SectionStress, adds_up_to_that_of_the_packing) {
  const Packing packing = test::random_packing(6, 400, 20.0, 10.0, true);
  const auto [xx, xy, yx, yy] = stressed(packing, 200.0).stress;
  Tensor2 difference = {-xx, -xy, -yx, -yy};
  for (const Tensor2& section : section_stresses(packing, 200.0, 7))
    matrix(difference) += matrix(section) / 7.0;
  EXPECT_LT(matrix(difference).norm(), 1e-12);
}

TEST(SectionStress, goes_by_the_centres) {
  Packing packing = test::empty_packing(10.0, false);
  const Tensor2 moment = {1.0, 0.0, 0.0, 2.0};
  test::add_grain(packing, 0.0, 0.0, 0.5, moment);
  test::add_grain(packing, 4.99, 0.0, 0.5, moment);
  test::add_grain(packing, 5.0, 0.0, 0.5, moment);
  test::add_grain(packing, 10.0, 0.0, 0.5, moment);  // the end belongs to the last section
  test::add_grain(packing, 9.0, 0.0, 0.5, moment);
  const std::vector<Tensor2> sections = section_stresses(packing, 4.0, 2);
  ASSERT_EQ(sections.size(), 2u);
  EXPECT_EQ(sections[0].xx, 1.0);
  EXPECT_EQ(sections[1].xx, 1.5);
  EXPECT_EQ(sections[1].yy, 3.0);
}

// See the test of bed_volume: the upper half of a disk is on average pi/4 r above its centre.
TEST(FrameVolume, is_the_area_below_the_surface) {
  for (const bool periodic : {false, true}) {
    Packing packing = test::empty_packing(10.0, periodic);
    for (Index k = 0; k < 10; ++k) test::add_grain(packing, k + 0.5, 0.75);
    test::add_floor_grain(packing, 5.0, 9.0);
    EXPECT_NEAR(frame_volume(packing), 10.0 * (0.75 + 0.125 * pi), 0.1);
  }
}

TEST(StressRatioDistribution, is_that_of_free_grains_that_carry_something) {
  Packing packing = stack_of(3);
  test::add_floor_grain(packing, 8.0, -0.5);
  packing.frame.gamma = {0.1, std::nan(""), 0.95, 0.5, 0.5};
  const Histogram histogram = stress_ratio_distribution(packing, 10);
  EXPECT_EQ(histogram.total, 2.0);
  EXPECT_EQ(histogram.weight[1], 1.0);
  EXPECT_EQ(histogram.weight[9], 1.0);
}

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

/// Computes the same over all pairs of points.
PairCorrelation plain_correlation(const std::vector<double>& x, const std::vector<double>& y,
                                  const std::vector<double>& value, double largest, int bins, double period) {
  const auto count = static_cast<double>(value.size());
  double mean = 0.0, variance = 0.0;
  for (const double each : value) mean += each / count;
  for (const double each : value) variance += (each - mean) * (each - mean) / count;
  const auto size = static_cast<std::size_t>(bins);
  PairCorrelation plain{{}, std::vector<double>(size, 0.0), std::vector<double>(size, 0.0)};
  for (std::size_t i = 0; i < value.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double dx = period > 0.0 ? std::remainder(x[i] - x[j], period) : x[i] - x[j];
      const double r = std::hypot(dx, y[i] - y[j]);
      if (r >= largest) continue;
      plain.value[static_cast<std::size_t>(r / (largest / bins))] += (value[i] - mean) * (value[j] - mean);
      ++plain.pairs[static_cast<std::size_t>(r / (largest / bins))];
    }
  for (std::size_t bin = 0; bin < size; ++bin) {
    plain.r.push_back((static_cast<double>(bin) + 0.5) * largest / bins);
    plain.value[bin] /= plain.pairs[bin] * variance;  // NaN without pairs
  }
  return plain;
}

TEST(PairCorrelation, equals_the_sum_over_all_pairs) {
  Random random(9);
  for (const bool periodic : {false, true})
    for (const double largest : {0.7, 5.0, 10.0, 40.0})
      for (const double highest : {0.0, 12.0, 1e7}) {
        std::vector<double> x, y, value;
        for (int k = 0; k < 200; ++k) {
          x.push_back(random.uniform(-3.0, 22.0));
          y.push_back(highest > 0.0 ? random.uniform(-1.0, 12.0) : 0.5);
          value.push_back(random.uniform());
        }
        y.back() = highest;
        const double period = periodic ? 20.0 : 0.0, farthest = periodic ? std::min(largest, 10.0) : largest;
        const PairCorrelation plain = plain_correlation(x, y, value, farthest, 10, period);
        x.push_back(x[7] + 0.1);
        y.push_back(y[7]);
        value.push_back(std::nan(""));  // does not count
        const PairCorrelation result = pair_correlation(x, y, value, farthest, 10, period);
        EXPECT_EQ(result.pairs, plain.pairs) << largest;
        for (std::size_t bin = 0; bin < 10; ++bin) {
          EXPECT_NEAR(result.r[bin], plain.r[bin], 1e-12);
          if (plain.pairs[bin] > 0.0)
            EXPECT_NEAR(result.value[bin], plain.value[bin], 1e-11) << largest;
          else
            EXPECT_TRUE(std::isnan(result.value[bin]));
        }
      }
}

TEST(PairCorrelation, of_a_periodic_bed_counts_pairs_up_to_half_a_period) {
  const PairCorrelation result =
      pair_correlation({1.0, 9.0, 4.0}, {0.5, 0.5, 0.5}, {1.0, 2.0, 3.0}, 20.0, 20, 10.0);
  EXPECT_EQ(result.pairs, (std::vector<double>{0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(PairCorrelation, is_the_same_wherever_the_period_is_cut) {
  const Packing packing = test::random_packing(10, 200, 20.0, 12.0, true);
  const Packing moved = test::moved(packing, 7.25);
  const PairCorrelation one = stress_ratio_correlation(packing, 5.0, 10);
  const PairCorrelation other = stress_ratio_correlation(moved, 5.0, 10);
  EXPECT_EQ(one.pairs, other.pairs);
  for (std::size_t bin = 0; bin < 10; ++bin) EXPECT_NEAR(one.value[bin], other.value[bin], 1e-12);
}

// A common value at each depth, the weight above, is not a correlation: here each grain also has an
// independent random part.
TEST(MeanStressCorrelation, is_not_that_of_depth) {
  Packing packing = test::empty_packing(24.0, true);
  Random random(13);
  std::vector<double> mean_stress;
  for (Index row = 0; row < 24; ++row)
    for (Index column = 0; column < 24; ++column) {
      const double radius = random.uniform(0.4, 0.5);
      const double p = (26.0 - row) * random.uniform(0.5, 1.5);
      const double half_moment = 0.5 * p * pi * radius * radius;
      mean_stress.push_back(p);
      test::add_grain(packing, column, row, radius, {half_moment, 0.0, 0.0, half_moment});
    }
  const PairCorrelation raw = pair_correlation(packing.frame.x, packing.frame.y, mean_stress, 4.5, 3, 24.0);
  const PairCorrelation result = mean_stress_correlation(packing, 4.5, 3);
  for (std::size_t bin = 0; bin < 3; ++bin) {
    EXPECT_GT(raw.value[bin], 0.5);
    EXPECT_LT(std::fabs(result.value[bin]), 0.1);
  }
}

TEST(MeanStressCorrelation, does_not_depend_on_the_size_of_grains) {
  Packing packing = test::empty_packing(20.0, true);
  Random random(14);
  for (Index k = 0; k < 20; ++k) {
    const double radius = random.uniform(0.2, 0.5);
    const double p = k % 2 == 0 ? 1.0 : 3.0;
    test::add_grain(packing, k, 0.5, radius, {pi * radius * radius * p, 0.0, 0.0, 0.0});
  }
  EXPECT_NEAR(mean_stress_correlation(packing, 4.5, 9).value[2], -1.0, 1e-12);
}

TEST(ForceCorrelation, is_that_of_normal_forces_at_contact_points) {
  Packing packing = test::empty_packing(20.0, true);
  for (Index k = 0; k < 20; ++k) test::add_grain(packing, k + 0.25, 0.5);
  for (Index k = 0; k + 1 < 20; ++k) test::add_contact(packing, k, k + 1, k % 2 == 0 ? 1.0 : 3.0);
  test::add_contact(packing, 0, 19, 3.0, 0.0, -1);
  const PairCorrelation result = force_correlation(packing, 4.5, 9);
  EXPECT_EQ(result.pairs[2], 20.0);
  EXPECT_NEAR(result.value[2], -1.0, 1e-12);
  EXPECT_NEAR(result.value[4], 1.0, 1e-12);
}

}  // namespace
}  // namespace talus::analysis
