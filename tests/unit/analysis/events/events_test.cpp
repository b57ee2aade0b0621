/// Bursts of a made-up series, and motion between two hand-made frames.

#include "analysis/events/events.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/trigonometry.h"

namespace talus::analysis {
namespace {

using Places = std::vector<std::vector<std::size_t>>;

Places places_of(const std::vector<Burst>& bursts) {
  Places places;
  for (const Burst& burst : bursts) places.push_back({burst.first, burst.last, burst.is_over ? 1u : 0u});
  return places;
}

TEST(Bursts, lie_between_quiet_times) {
  const std::vector<double> v = {0, 2, 1, 0, 3, 0, 0, 1, 0, 0, 0, 5};
  EXPECT_EQ(places_of(find_bursts(v, 1.0, 1)), (Places{{1, 2, 1}, {4, 4, 1}, {7, 7, 1}, {11, 11, 0}}));
  EXPECT_EQ(places_of(find_bursts(v, 1.0, 2)), (Places{{1, 4, 1}, {7, 7, 1}, {11, 11, 0}}));
  EXPECT_EQ(places_of(find_bursts(v, 1.0, 3)), (Places{{1, 7, 1}, {11, 11, 0}}));
  EXPECT_EQ(places_of(find_bursts(v, 1.0, 4)), (Places{{1, 11, 0}}));
  EXPECT_EQ(places_of(find_bursts(v, 2.5, 1)), (Places{{4, 4, 1}, {11, 11, 0}}));
  EXPECT_TRUE(find_bursts(v, 9.0, 1).empty());
  EXPECT_TRUE(find_bursts({}, 1.0, 1).empty());
}

TEST(Bursts, are_over_only_after_a_whole_quiet_time) {
  const std::vector<double> v = {3, 0, 0};
  EXPECT_TRUE(find_bursts(v, 1.0, 2).front().is_over);
  EXPECT_FALSE(find_bursts(v, 1.0, 3).front().is_over);
  EXPECT_TRUE(find_bursts(std::vector<double>{not_known, not_known}, 1.0, 1).empty());
}

TEST(Bursts, leave_quiet_steps_with_a_median) {
  const std::vector<double> v = {0.1, 2, 0.5, 2, 0.2, 0.3};
  EXPECT_EQ(quiet_velocity(v, find_bursts(v, 1.0, 2)), 0.2) << "0.5 belongs to the burst";
  EXPECT_TRUE(
      std::isnan(quiet_velocity(std::vector<double>{2.0}, find_bursts(std::vector<double>{2.0}, 1.0, 1))));
}

/// Three free grains of 1, 2 and 3 kg/m and a floor grain, in a bed 10 m long.
struct TwoFrames {
  RunStatics statics;
  Frame before, after;

  explicit TwoFrames(bool periodic) {
    statics.free_count = 3;
    statics.mass = {1.0, 2.0, 3.0, 9.0};
    statics.periodic = periodic;
    statics.length = 10.0;
    statics.gravity = 10.0;
    before.x = after.x = {9.8, 5.0, 1.0, 5.0};
    before.y = after.y = {4.0, 2.0, 3.0, 0.0};
    before.image = after.image = {0, 0, 0, 0};
  }
};

TEST(MeanDisplacement, counts_the_periods_that_a_grain_has_passed) {
  TwoFrames pair(true);
  pair.after.x[0] = 0.1;
  pair.after.image[0] = 3;  // 0.3 m to the edge, and two periods
  pair.after.x[2] = 7.0;    // more than half a period, and not across the edge
  const Vec2 moved = mean_displacement(pair.before, pair.after, pair.statics);
  EXPECT_NEAR(moved.x, (1.0 * 20.3 + 3.0 * 6.0) / 6.0, 1e-12);
}

TEST(GravityWork, is_that_on_the_centre_of_mass) {
  TwoFrames pair(true);
  pair.after.x[0] += 0.6;
  pair.after.y[1] -= 0.3;
  pair.after.x[3] += 5.0;  // the floor does not count
  const Vec2 moved = mean_displacement(pair.before, pair.after, pair.statics);
  EXPECT_NEAR(moved.x, 0.1, 1e-12);
  EXPECT_NEAR(moved.y, -0.1, 1e-12);
  EXPECT_NEAR(gravity_work(pair.statics, moved, radians(30.0)),
              1.0 * 10.0 * 0.6 * 0.5 + 2.0 * 10.0 * 0.3 * std::cos(radians(30.0)), 1e-9);
}

TEST(Movement, counts_the_grains_that_moved_and_says_where) {
  TwoFrames pair(false);
  pair.after.x[0] += 0.3;
  pair.after.y[2] -= 0.1;
  pair.after.x[1] += 0.01;
  const Movement all = movement_between(pair.before, pair.after, pair.statics, 0.05, 5.0);
  EXPECT_EQ(all.grains, 2);
  EXPECT_NEAR(all.centre.x, (0.3 * 9.8 + 0.1 * 1.0) / 0.4, 1e-12);
  EXPECT_NEAR(all.centre.y, (0.3 * 4.0 + 0.1 * 3.0) / 0.4, 1e-12);
  EXPECT_NEAR(all.depth, 2.0, 1e-12) << "three quarters lie 1 m deep, the rest 2 m";
  const Movement none = movement_between(pair.before, pair.after, pair.statics, 1.0, 5.0);
  EXPECT_EQ(none.grains, 0);
  EXPECT_TRUE(std::isnan(none.depth));
  EXPECT_TRUE(std::isnan(none.centre.x));
}

TEST(Movement, of_whole_periods_is_movement) {
  TwoFrames pair(true);
  pair.after.image[0] = 2;
  const Movement movement = movement_between(pair.before, pair.after, pair.statics, 19.9, 5.0);
  EXPECT_EQ(movement.grains, 1);
  EXPECT_NEAR(movement.centre.x, 9.8, 1e-12);
}

TEST(Movement, around_the_period_has_its_centre_there) {
  TwoFrames pair(true);
  pair.after.y[0] += 0.2;
  pair.before.x[1] = pair.after.x[1] = 0.2;
  pair.after.y[1] += 0.2;
  const double centre = movement_between(pair.before, pair.after, pair.statics, 0.1, 5.0).centre.x;
  EXPECT_NEAR(centre - 10.0 * std::round(centre / 10.0), 0.0, 1e-9) << "between 9.8 and 10.2";
}

}  // namespace
}  // namespace talus::analysis
