#include "analysis/contacts/contact_changes.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "unit/analysis/packings.h"

namespace talus::analysis {
namespace {

using test::add_contact, test::add_grain, test::empty_packing, test::Packing;
using Places = std::vector<Index>;

/// Returns three grains in a row, at 0.5, 1.5, 2.5, without contacts; images 0.
Packing three_grains() {
  Packing packing = empty_packing(10.0, true);
  for (const double x : {0.5, 1.5, 2.5}) add_grain(packing, x, 0.5);
  packing.frame.image.assign(3, 0);
  return packing;
}

TEST(ContactChanges, report_changes) {
  Packing before = three_grains(), after = three_grains();
  add_contact(before, 0, 1, 1.0);
  add_contact(before, 1, 2, 1.0);
  add_contact(after, 0, 2, 2.0);
  add_contact(after, 1, 2, 5.0, 2.5);  // force and status do not matter
  const ContactChanges changes = contact_changes(before.frame, after.frame);
  EXPECT_EQ(changes.gained, (Places{0}));
  EXPECT_EQ(changes.lost, (Places{0}));
  const ContactChanges back = contact_changes(after.frame, before.frame);
  EXPECT_EQ(back.gained, (Places{0}));
  EXPECT_EQ(back.lost, (Places{0}));
}

TEST(ContactChanges, of_a_frame_and_itself_are_none) {
  Packing packing = three_grains();
  add_contact(packing, 0, 1, 1.0);
  add_contact(packing, 0, 2, 1.0, 0.0, -1);
  const ContactChanges changes = contact_changes(packing.frame, packing.frame);
  EXPECT_TRUE(changes.gained.empty());
  EXPECT_TRUE(changes.lost.empty());
}

TEST(ContactChanges, a_pair_that_goes_through_the_edge_keeps_its_contact) {
  Packing before = three_grains(), after = three_grains();
  add_contact(before, 0, 1, 1.0);
  // Grain 0 has left on the left and re-entered on the right: seen from it, grain 1 is one period farther.
  after.frame.x[0] = 9.5;
  after.frame.image[0] = -1;
  add_contact(after, 0, 1, 1.0, 0.0, 1);
  EXPECT_TRUE(contact_changes(before.frame, after.frame).gained.empty());
  EXPECT_TRUE(contact_changes(before.frame, after.frame).lost.empty());
  // Now grain 1 has done so too.
  after.frame.x[1] = 9.9;
  after.frame.image[1] = -1;
  after.frame.contacts.shift[0] = 0;
  EXPECT_TRUE(contact_changes(before.frame, after.frame).gained.empty());
}

TEST(ContactChanges, another_image_of_a_grain_is_another_neighbour) {
  Packing before = three_grains(), after = three_grains();
  add_contact(before, 0, 1, 1.0);
  add_contact(after, 0, 1, 1.0, 0.0, -1);
  EXPECT_EQ(contact_changes(before.frame, after.frame).gained, (Places{0}));
  EXPECT_EQ(contact_changes(before.frame, after.frame).lost, (Places{0}));
}

TEST(ContactChanges, a_smooth_floor_is_one_body_in_all_periods) {
  Packing before = three_grains(), after = three_grains();
  add_contact(before, 0, 1, 1.0);
  add_contact(after, 0, 1, 1.0);
  for (Packing* packing : {&before, &after}) packing->frame.contacts.b[0] = 3;  // a plane
  after.frame.image[0] = 1;
  EXPECT_TRUE(contact_changes(before.frame, after.frame).gained.empty());
}

TEST(ContactChanges, are_between_frames_of_the_same_grains) {
  Packing more = three_grains();
  add_grain(more, 5.0, 0.5);
  EXPECT_THROW(contact_changes(three_grains().frame, more.frame), Error);
}

}  // namespace
}  // namespace talus::analysis
