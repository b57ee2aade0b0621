#include "analysis/cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace talus::analysis {
namespace {

struct Places {
  std::vector<double> x, y;
};

Places random_places(int count) {
  Random random(21);
  Places places;
  for (int k = 0; k < count; ++k) {
    places.x.push_back(random.uniform(0.0, 20.5));
    places.y.push_back(random.uniform(-3.0, 7.0));
  }
  return places;
}

TEST(Cells, rings_meet_each_point_once_and_the_near_ones_first) {
  const Places places = random_places(100);
  for (const double period : {0.0, 20.5})
    for (const double size : {1.0, 3.0, 30.0}) {
      const Cells cells = sort_into_cells(places.x, places.y, size, period);
      for (std::size_t i = 0; i < 100; ++i) {
        std::vector<Index> met;
        bool more = true;
        for (Index ring = 0; more; ++ring) {
          const auto record = [&](Index j) {
            met.push_back(j);
            double dx = places.x[j] - places.x[i];
            dx += nearest_image(dx, period) * period;
            // A grain left for this ring is farther away than the previous rings.
            EXPECT_GE(std::hypot(dx, places.y[j] - places.y[i]), std::max(0, ring - 1) * cells.size);
          };
          more = visit_ring(cells, column_of(cells, places.x[i]), row_of(cells, places.y[i]), ring, record);
        }
        std::sort(met.begin(), met.end());
        ASSERT_EQ(met.size(), 100u);
        EXPECT_TRUE(std::adjacent_find(met.begin(), met.end()) == met.end());
      }
    }
}

TEST(Cells, of_a_point_far_away_are_not_many) {
  Places places = random_places(100);
  places.y[50] = 1e5;
  EXPECT_LT(sort_into_cells(places.x, places.y, 1.0, 20.5).start.size(), 1000u);
}

TEST(Cells, of_nothing) {
  const Cells cells = sort_into_cells({}, {}, 1.0, 0.0);
  visit_ring(cells, 0, 0, 0, [](Index) { FAIL(); });
}

TEST(NearestImage, is_at_most_half_a_period_away) {
  EXPECT_EQ(nearest_image(4.0, 10.0), 0);
  EXPECT_EQ(nearest_image(6.0, 10.0), -1);
  EXPECT_EQ(nearest_image(-6.0, 10.0), 1);
  EXPECT_EQ(nearest_image(6.0, 0.0), 0);
  EXPECT_EQ(nearest_image(-6.0, 0.0), 0);
}

}  // namespace
}  // namespace talus::analysis
