#include "session/bed_table.h"

#include <gtest/gtest.h>

#include "core/errors.h"

namespace talus {
namespace {

void expect_two_grains(const std::string& text, std::size_t first_line = 1, std::size_t second_line = 2) {
  const std::vector<TableGrain> grains = parse_bed_table(text, "bed.csv");
  ASSERT_EQ(grains.size(), 2u) << text;
  EXPECT_EQ(grains[0].x, 0.5);
  EXPECT_EQ(grains[0].y, 1.25);
  EXPECT_EQ(grains[0].radius, 0.4);
  EXPECT_EQ(grains[0].line, first_line);
  EXPECT_EQ(grains[1].x, 3.0);
  EXPECT_EQ(grains[1].y, -0.125);
  EXPECT_EQ(grains[1].radius, 0.6);
  EXPECT_EQ(grains[1].line, second_line);
}

TEST(BedTable, has_commas_or_white_space_between_its_numbers) {
  expect_two_grains("0.5,1.25,0.4\n3,-0.125,0.6\n");
  expect_two_grains("0.5 , 1.25,\t0.4\n  +3,-.125,6e-1  ");
  expect_two_grains("0.5 1.25 0.4\n3\t-0.125  0.6\n");
  expect_two_grains("\t0.5   1.25 0.4\r\n3 -0.125 0.6\r\n");
}

TEST(BedTable, may_have_names_comments_and_empty_lines) {
  expect_two_grains("x,y,radius\n0.5,1.25,0.4\n3,-0.125,0.6\n", 2, 3);
  expect_two_grains("X Y Radius\n0.5 1.25 0.4\n3 -0.125 0.6\n", 2, 3);
  expect_two_grains("# a bed\n\nx,y,radius # in D\n0.5,1.25,0.4# first\n\n#\n3,-0.125,0.6", 4, 7);
}

TEST(BedTable, without_lines_has_no_grain) {
  for (const char* text : {"", "\n\n", "# nothing", "x,y,radius\n"})
    EXPECT_TRUE(parse_bed_table(text, "bed.csv").empty()) << text;
}

std::string message_of(const std::string& text) {
  try {
    parse_bed_table(text, "bed.csv");
  } catch (const LocatedError& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    return error.what();
  }
  return "accepted";
}

TEST(BedTable, tells_where_it_cannot_be_read) {
  const std::string number = ": expected a finite number, in mean diameters D";
  EXPECT_EQ(message_of("1,2,0.5\n1, two,0.5\n"), "bed.csv:2:4: error: y = \"two\"" + number);
  EXPECT_EQ(message_of("1,2,0.5\nx,y,radius\n"), "bed.csv:2:1: error: x = \"x\"" + number)
      << "names come first";
  EXPECT_EQ(message_of("radius,x,y\n"), "bed.csv:1:1: error: x = \"radius\"" + number) << "in another order";
  EXPECT_EQ(message_of("1 2 nan\n"), "bed.csv:1:5: error: radius = \"nan\"" + number);
  EXPECT_EQ(message_of("inf,2,1\n"), "bed.csv:1:1: error: x = \"inf\"" + number);
  EXPECT_EQ(message_of("1,1e999,1\n"), "bed.csv:1:3: error: y = \"1e999\"" + number);
  EXPECT_EQ(message_of("1,,1\n"), "bed.csv:1:3: error: y = \"\"" + number);
  EXPECT_EQ(message_of("1,2,0x1\n"), "bed.csv:1:5: error: radius = \"0x1\"" + number);
  EXPECT_EQ(message_of("1,2 3,4\n"), "bed.csv:1:3: error: y = \"2 3\"" + number);
}

TEST(BedTable, has_three_values_in_a_line) {
  const auto has = [](const std::string& count) {
    return "error: the line has " + count + " values: expected three, x, y and radius";
  };
  EXPECT_EQ(message_of("# one\n  1,2\n"), "bed.csv:2:3: " + has("2"));
  EXPECT_EQ(message_of("1 2 3 4\n"), "bed.csv:1:1: " + has("4"));
  EXPECT_EQ(message_of("1,2,3,\n"), "bed.csv:1:1: " + has("4"));
}

TEST(BedTable, has_radii_above_zero) {
  const std::string expected = ": expected a finite number > 0, in mean diameters D";
  EXPECT_EQ(message_of("1,2,-0.5\n"), "bed.csv:1:5: error: radius = -0.5" + expected);
  EXPECT_EQ(message_of("1,2,0\n"), "bed.csv:1:5: error: radius = 0" + expected);
}

}  // namespace
}  // namespace talus
