#include "figures/contact_lines.h"

#include <gtest/gtest.h>

#include <cmath>

#include "figures/recipes.h"
#include "unit/analysis/packings.h"

namespace talus::figures {
namespace {

void expect_line(const ContactLine& line, Index contact, double x1, double y1, double x2, double y2) {
  EXPECT_EQ(line.contact, contact);
  EXPECT_DOUBLE_EQ(line.x1, x1);
  EXPECT_DOUBLE_EQ(line.y1, y1);
  EXPECT_DOUBLE_EQ(line.x2, x2);
  EXPECT_DOUBLE_EQ(line.y2, y2);
}

/// Returns two contacts across the edge of a period of 8, one in each direction, a contact inside, and one
/// with the floor.
test::Packing across_the_edge() {
  test::Packing packing = test::empty_packing(8.0, true);
  test::add_grain(packing, 7.5, 1.0);
  test::add_grain(packing, 1.5, 3.0);
  test::add_grain(packing, 2.5, 3.0);
  test::add_floor_grain(packing, 7.5, 0.0);
  test::add_contact(packing, 0, 1, 2.0, 0.0, 1);
  test::add_contact(packing, 1, 0, 4.0, 2.0, -1);
  test::add_contact(packing, 1, 2, 1.0);
  test::add_contact(packing, 0, 3, 5.0);
  return packing;
}

TEST(ContactLines, AreCutAtThePeriodicEdge) {
  const test::Packing packing = across_the_edge();
  const std::vector<ContactLine> lines = contact_lines({packing.frame, packing.statics});
  ASSERT_EQ(lines.size(), 6u);
  expect_line(lines[0], 0, 7.5, 1.0, 8.0, 1.5);
  expect_line(lines[1], 0, 0.0, 1.5, 1.5, 3.0);
  expect_line(lines[2], 1, 1.5, 3.0, 0.0, 1.5);
  expect_line(lines[3], 1, 8.0, 1.5, 7.5, 1.0);
  expect_line(lines[4], 2, 1.5, 3.0, 2.5, 3.0);
  expect_line(lines[5], 3, 7.5, 1.0, 7.5, 0.0);
}

// In single precision a grain can lie exactly at the period.
TEST(ContactLines, AreCutWhereTheirEndLiesOnTheEdge) {
  test::Packing packing = test::empty_packing(8.0, true);
  test::add_grain(packing, 0.5, 1.0);
  test::add_grain(packing, 8.0, 1.5);
  test::add_contact(packing, 0, 1, 2.0, 0.0, -1);
  const std::vector<ContactLine> lines = contact_lines({packing.frame, packing.statics});
  ASSERT_EQ(lines.size(), 2u);
  expect_line(lines[0], 0, 0.5, 1.0, 0.0, 1.5);
  expect_line(lines[1], 0, 8.0, 1.5, 8.0, 1.5);
}

TEST(ContactLines, EndAtAWall) {
  test::Packing packing = test::empty_packing(8.0, false);
  test::add_grain(packing, 0.5, 1.0);
  test::add_grain(packing, 1.5, 1.0);
  test::add_contact(packing, 0, 1, 1.0);
  FrameContacts& contacts = packing.frame.contacts;
  contacts.b[0] = 2;  // first plane
  contacts.px[0] = 0.0;
  const std::vector<ContactLine> lines = contact_lines({packing.frame, packing.statics});
  ASSERT_EQ(lines.size(), 1u);
  expect_line(lines[0], 0, 0.5, 1.0, 0.0, 1.0);
}

TEST(SurfaceLine, IsTheUpperEnvelope) {
  test::Packing packing = test::empty_packing(2.0, false);
  test::add_grain(packing, 0.625, 1.0, 0.5);
  const SurfaceLine line = surface_line({packing.frame, packing.statics});
  ASSERT_EQ(line.x.size(), 8u);
  EXPECT_DOUBLE_EQ(line.x[2], 0.625);
  EXPECT_DOUBLE_EQ(line.y[2], 1.5);
  EXPECT_DOUBLE_EQ(line.y[6], 0.0);
}

TEST(ForceTable, HasForcesOverTheirMeanTheStrongestLast) {
  const test::Packing packing = across_the_edge();
  const Table table = force_table({packing.frame, packing.statics});
  const double mean = (2.0 + 4.0 + 1.0 + 5.0) / 4.0;  // a contact that is cut counts once
  const auto rounded = [](double value) { return std::round(1e4 * value) / 1e4; };
  EXPECT_EQ(table.columns[4].values,
            (std::vector<double>{rounded(1 / mean), rounded(2 / mean), rounded(2 / mean), rounded(4 / mean),
                                 rounded(4 / mean), rounded(5 / mean)}));
  EXPECT_EQ(table.columns[5].values, (std::vector<double>{0, 0, 0, 1, 1, 0}));
  EXPECT_EQ(table.columns[0].values, (std::vector<double>{1.5, 7.5, 0, 1.5, 8, 7.5}));
}

TEST(ForceTable, MeasuresInMeanDiameters) {
  test::Packing packing = across_the_edge();
  packing.statics.mean_diameter = 0.5;
  const Table table = force_table({packing.frame, packing.statics});
  EXPECT_EQ(table.columns[2].values.front(), 5.0);
  EXPECT_EQ(table.columns[3].values.front(), 6.0);
}

}  // namespace
}  // namespace talus::figures
