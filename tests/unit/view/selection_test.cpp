/// Finding grains and contacts by position.

#include "view/selection.h"

#include <gtest/gtest.h>

#include "unit/view/example_bed.h"

namespace talus::view {
namespace {

const RunStatics statics = example::bed_statics();
const Frame frame = example::bed_frame(10.0, 2);
const BedFrame bed{frame, statics};

TEST(Selected, a_grain_is_added_or_removed) {
  const std::vector<Index> before = {2, 5, 7};
  EXPECT_EQ(toggled(before, 5), (std::vector<Index>{2, 7}));
  EXPECT_EQ(toggled(before, 6), (std::vector<Index>{2, 5, 6, 7}));
  EXPECT_EQ(toggled({}, 3), (std::vector<Index>{3}));
}

TEST(Selected, grains_are_within_a_box_by_their_centres) {
  const std::vector<Vec2> box = {{0.4, 0.4}, {2.6, 0.4}, {2.6, 1.6}, {0.4, 1.6}};
  EXPECT_EQ(grains_within(bed, box), (std::vector<Index>{0, 1, 2, 10, 11, 12}));
  const std::vector<Vec2> backwards = {{2.6, 1.6}, {0.4, 1.6}, {0.4, 0.4}, {2.6, 0.4}};
  EXPECT_EQ(grains_within(bed, backwards), grains_within(bed, box));
}

TEST(Selected, the_floor_is_not_found) {
  const std::vector<Vec2> all = {{0.0, -5.0}, {10.0, -5.0}, {10.0, 9.0}, {0.0, 9.0}};
  EXPECT_EQ(grains_within(bed, all).size(), static_cast<std::size_t>(statics.free_count));
}

TEST(Selected, a_lasso_may_be_hollow) {
  const std::vector<Vec2> u = {{0.0, 0.0}, {3.0, 0.0}, {3.0, 3.0}, {2.0, 3.0},
                               {2.0, 1.0}, {1.0, 1.0}, {1.0, 3.0}, {0.0, 3.0}};
  EXPECT_EQ(grains_within(bed, u), (std::vector<Index>{0, 1, 2, 10, 12, 20, 22}));
  EXPECT_TRUE(grains_within(bed, std::span(u).first(2)).empty());
}

TEST(Selected, images_across_the_edge_are_found) {
  const std::vector<Vec2> left = {{-0.6, 0.0}, {0.6, 0.0}, {0.6, 1.0}, {-0.6, 1.0}};
  EXPECT_EQ(grains_within(bed, left), (std::vector<Index>{0, 9}));
  RunStatics walls = statics;
  walls.periodic = false;
  EXPECT_EQ(grains_within({frame, walls}, left), (std::vector<Index>{0}));
}

TEST(Selected, the_nearest_contact_is_found) {
  const auto found = find_contact(bed, 3.45, 2.05, 0.2);
  EXPECT_EQ(found, (ContactKey{13, 23, 0}));
  EXPECT_FALSE(find_contact(bed, 3.5, 2.5, 0.2));
  EXPECT_EQ(find_contact(bed, 3.5 - statics.length, 2.0, 0.2), found) << "an image of it";
}

TEST(Selected, a_contact_is_known_by_its_key) {
  Frame sorted = frame;
  FrameContacts& c = sorted.contacts;
  c.a = {0, 0, 0, 4};
  c.b = {1, 9, 9, 5};
  c.shift = {0, -1, 0, 0};
  EXPECT_EQ(contact_of_key(c, {0, 9, -1}), std::optional<Index>(1));
  EXPECT_EQ(contact_of_key(c, {0, 9, 0}), std::optional<Index>(2));
  EXPECT_EQ(contact_of_key(c, {4, 5, 0}), std::optional<Index>(3));
  for (const ContactKey& missing : {ContactKey{0, 9, 1}, {4, 6, 0}, {9, 10, 0}, {0, 0, 0}})
    EXPECT_FALSE(contact_of_key(c, missing));
}

}  // namespace
}  // namespace talus::view
