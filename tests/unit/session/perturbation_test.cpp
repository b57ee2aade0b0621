/// Patches and pushes on hand-placed grains, and the search for a known threshold.

#include "session/perturbation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "session/perturbation_threshold.h"

namespace talus::session {
namespace {

constexpr double diameter = 0.01;

/// Returns three layers of ten disks on top of each other: ids 0 ... 9 at the floor, 20 ... 29 at the
/// surface.
World layers(bool periodic) {
  World world;
  world.boundary.periodic = periodic;
  world.boundary.length = 10 * diameter;
  for (int layer = 0; layer < 3; ++layer)
    for (int k = 0; k < 10; ++k)
      add_disk(world.grains, {(k + 0.5) * diameter, (layer + 0.5) * diameter}, 0.5 * diameter, 2500.0, false);
  return world;
}

std::vector<Index> patch_at(const World& world, double width, double depth, double centre) {
  return grains_in_patch(world, {width, depth}, centre * diameter, diameter);
}

using Ids = std::vector<Index>;

TEST(SurfacePatch, has_the_grains_of_its_width_and_depth) {
  const World world = layers(true);
  EXPECT_EQ(patch_at(world, 4.0, 1.0, 5.0), (Ids{23, 24, 25, 26}));
  EXPECT_EQ(patch_at(world, 2.0, 2.0, 5.0), (Ids{14, 15, 24, 25}));
  EXPECT_EQ(patch_at(world, 0.5, 9.0, 5.0), Ids{});
}

TEST(SurfacePatch, goes_across_the_periodic_edge_and_ends_at_a_wall) {
  EXPECT_EQ(patch_at(layers(true), 4.0, 1.0, 0.0), (Ids{20, 21, 28, 29}));
  EXPECT_EQ(patch_at(layers(true), 4.0, 1.0, 9.0), (Ids{20, 27, 28, 29}));
  EXPECT_EQ(patch_at(layers(false), 4.0, 1.0, 0.0), (Ids{20, 21}));
}

TEST(SurfacePatch, is_counted_from_the_surface_above_it) {
  World world = layers(true);
  for (int k = 0; k < 5; ++k)
    for (int storey : {3, 4})
      add_disk(world.grains, {(k + 0.5) * diameter, (storey + 0.5) * diameter}, 0.5 * diameter, 2500.0,
               false);
  EXPECT_EQ(patch_at(world, 2.0, 1.0, 2.0), (Ids{33, 35})) << "the mound, ids 30 ... 39";
  EXPECT_EQ(patch_at(world, 2.0, 1.0, 7.0), (Ids{26, 27})) << "the flat part next to it";
}

TEST(Push, gives_its_grains_the_velocity_and_says_the_energy) {
  World world = layers(true);
  world.grains.vx[3] = 0.1;
  const Ids pushed = {3, 7};
  const double energy = push(world.grains, pushed, 0.2);
  const double mass = world.grains.mass[3];
  EXPECT_NEAR(energy, 0.5 * mass * (0.3 * 0.3 - 0.1 * 0.1 + 0.2 * 0.2), 1e-12 * mass);
  EXPECT_DOUBLE_EQ(world.grains.vx[3], 0.3);
  EXPECT_DOUBLE_EQ(world.grains.vx[7], 0.2);
  EXPECT_EQ(world.grains.vx[5], 0.0);
}

Trial trial(double strength, TrialEnd end) {
  Trial made;
  made.strength = strength;
  made.end = end;
  return made;
}

/// Searches in a bed that every push of at least `threshold` destabilises.
std::vector<Trial> search(double threshold) {
  return search_threshold([=](double strength) {
    return trial(strength, strength >= threshold ? TrialEnd::avalanche : TrialEnd::rest);
  });
}

TEST(ThresholdSearch, brackets_a_threshold_within_its_factor) {
  const double factor = std::pow(strongest_push / weakest_push, 1.0 / (1 << threshold_bisections));
  for (const double threshold : {0.06, 0.3, 0.7, 2.0, 4.9}) {
    const std::vector<Trial> trials = search(threshold);
    const Threshold found = threshold_of(trials);
    EXPECT_LT(found.without, threshold);
    EXPECT_GE(found.with, threshold);
    EXPECT_NEAR(found.with / found.without, factor, 1e-9);
    EXPECT_TRUE(found.held && found.monotone);
    EXPECT_LE(trials.size(), 9u);
    for (const Trial& made : trials) EXPECT_LE(made.strength, strongest_push);
  }
}

TEST(ThresholdSearch, ends_where_nothing_or_everything_sets_off_an_avalanche) {
  EXPECT_EQ(search(1e9).size(), 1u);
  EXPECT_EQ(threshold_of(search(1e9)).without, strongest_push);
  EXPECT_TRUE(std::isinf(threshold_of(search(1e9)).with));
  EXPECT_EQ(search(0.0).size(), 2u);
  EXPECT_EQ(threshold_of(search(0.0)).without, 0.0);
  EXPECT_EQ(threshold_of(search(0.0)).with, weakest_push);
}

TEST(ThresholdSearch, says_where_a_stronger_push_is_absorbed_or_a_weaker_is_not) {
  const auto monotone = [](double quiet_from, double quiet_to, double loud_from, double loud_to) {
    return threshold_of(search_threshold([=](double strength) {
             const bool quiet = strength > quiet_from && strength < quiet_to;
             const bool loud = strength > loud_from && strength < loud_to;
             const bool avalanche = (strength >= 0.7 && !quiet) || loud;
             return trial(strength, avalanche ? TrialEnd::avalanche : TrialEnd::rest);
           }))
        .monotone;
  };
  EXPECT_TRUE(monotone(0, 0, 0, 0));
  EXPECT_FALSE(monotone(0.9, 1.4, 0, 0));
  EXPECT_FALSE(monotone(0, 0, 0.35, 0.49));
}

TEST(ThresholdSearch, counts_an_undecided_trial_as_neither) {
  const std::vector<Trial> trials = search_threshold([](double strength) {
    const bool near = strength > 0.4 && strength < 0.6;
    return trial(strength, near             ? TrialEnd::undecided
                           : strength > 0.5 ? TrialEnd::avalanche
                                            : TrialEnd::rest);
  });
  const Threshold found = threshold_of(trials);
  EXPECT_EQ(found.without, weakest_push);
  EXPECT_EQ(found.with, strongest_push);
  EXPECT_TRUE(found.monotone);
  EXPECT_EQ(trials.size(), 4u) << "strongest, weakest, undecided, and the check below";
}

TEST(Threshold, of_a_bed_that_does_not_hold_is_zero) {
  const Threshold found = threshold_of(std::vector{trial(0.0, TrialEnd::avalanche)});
  EXPECT_FALSE(found.held);
  EXPECT_EQ(found.with, 0.0);
  EXPECT_FALSE(threshold_of(std::vector{trial(0.0, TrialEnd::undecided)}).held);
  EXPECT_TRUE(threshold_of(std::vector{trial(0.0, TrialEnd::rest)}).held);
}

}  // namespace
}  // namespace talus::session
