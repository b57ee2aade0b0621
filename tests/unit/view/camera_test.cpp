/// Part of the bed shown, for a bed of 100 x 20 m with mean diameter 1 m.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/trigonometry.h"
#include "view/view_state.h"

namespace talus::view {
namespace {

const pictures::MapExtent bed{0.0, 100.0, -1.0, 19.0};

pictures::MapExtent part(const ViewCamera& camera, double aspect, double turn_deg = 0.0) {
  return shown_part(camera, bed, 1.0, aspect, radians(turn_deg));
}

double length(const pictures::MapExtent& extent) { return extent.x_max - extent.x_min; }
double depth(const pictures::MapExtent& extent) { return extent.y_max - extent.y_min; }

TEST(Camera, shows_all_of_the_bed_in_the_middle_of_the_picture) {
  for (const double aspect : {0.5, 2.0, 5.0, 20.0}) {
    const pictures::MapExtent shown = part({3.0, 3.0, 1.0}, aspect);
    EXPECT_NEAR(length(shown) / depth(shown), aspect, 1e-12);
    EXPECT_LE(shown.x_min, 1e-12);
    EXPECT_GE(shown.x_max, 100.0 - 1e-12);
    EXPECT_LE(shown.y_min, -1.0 + 1e-12);
    EXPECT_GE(shown.y_max, 19.0 - 1e-12);
    EXPECT_NEAR(0.5 * (shown.x_min + shown.x_max), 50.0, 1e-12);
    EXPECT_NEAR(0.5 * (shown.y_min + shown.y_max), 9.0, 1e-12);
    EXPECT_NEAR(std::min(length(shown) - 100.0, depth(shown) - 20.0), 0.0, 1e-12)
        << "no larger than necessary";
  }
}

TEST(Camera, zooms_about_its_centre) {
  const pictures::MapExtent shown = part({40.0, 9.0, 10.0}, 2.0);
  EXPECT_NEAR(shown.x_min, 35.0, 1e-12);
  EXPECT_NEAR(shown.x_max, 45.0, 1e-12);
  EXPECT_NEAR(shown.y_min, 6.5, 1e-12);
  EXPECT_NEAR(shown.y_max, 11.5, 1e-12);
}

TEST(Camera, does_not_lose_the_bed) {
  const pictures::MapExtent corner = part({1000.0, -1000.0, 10.0}, 2.0);
  EXPECT_NEAR(corner.x_max, 100.0, 1e-12);
  EXPECT_NEAR(corner.y_min, -1.0, 1e-12);
  EXPECT_NEAR(length(corner), 10.0, 1e-12);
  EXPECT_NEAR(length(part({50.0, 9.0, 0.01}, 5.0)), 100.0, 1e-12);
  EXPECT_NEAR(length(part({50.0, 9.0, 1e9}, 5.0)), 3.0, 1e-12);
}

/// The part fits into the picture when it is turned by any angle up to the largest, and has the picture's
/// aspect.
TEST(Camera, finds_the_part_that_fills_the_picture_when_it_is_turned) {
  for (const double turn : {5.0, 20.0, 35.0})
    for (const double aspect : {0.8, 1.3, 1.7}) {
      const pictures::MapExtent shown = part({50.0, 9.0, 1.0}, aspect, turn);
      EXPECT_LE(shown.x_min, 1e-9);
      EXPECT_LE(shown.y_min, -1.0 + 1e-9);
      EXPECT_GE(depth(shown), 20.0 - 1e-9);
      double width = 0.0, height = 0.0;
      for (double angle = 0.0; angle <= turn + 1e-9; angle += turn / 1000.0) {
        const double c = std::cos(radians(angle)), s = std::sin(radians(angle));
        width = std::max(width, length(shown) * c + depth(shown) * s);
        height = std::max(height, depth(shown) * c + length(shown) * s);
      }
      EXPECT_NEAR(width / height, aspect, 1e-3 * aspect) << turn << " deg";
    }
}

TEST(Camera, centred_is_where_the_part_is) {
  const ViewCamera camera{1000.0, -1000.0, 10.0};
  const ViewCamera back = centred(camera, part(camera, 2.0));
  EXPECT_NEAR(back.centre_x, 95.0, 1e-12);
  EXPECT_NEAR(back.centre_y, 1.5, 1e-12);
  EXPECT_EQ(back.zoom, 10.0);
}

TEST(Camera, common_part_is_what_lies_within_both) {
  const pictures::MapExtent both = common_part(bed, {10.0, 200.0, -5.0, 7.0});
  EXPECT_EQ(both.x_min, 10.0);
  EXPECT_EQ(both.x_max, 100.0);
  EXPECT_EQ(both.y_min, -1.0);
  EXPECT_EQ(both.y_max, 7.0);
}

}  // namespace
}  // namespace talus::view
