#include "session/bed_table.h"

#include <gtest/gtest.h>

#include "support/exit_code.h"

namespace talus::session {
namespace {

void expect_two_grains(const std::string& text, std::size_t first_line = 1, std::size_t second_line = 2,
                       scenario::LengthUnit unit = scenario::LengthUnit::mean_diameter) {
  const std::vector<TableGrain> grains = parse_bed_table(text, "bed.csv", {unit}).grains;
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

std::string message_of(const std::string& text) {
  const test::Refusal refusal = test::refusal_of([&] { parse_bed_table(text, "bed.csv", {}); });
  EXPECT_EQ(refusal.code, ExitCode::bad_data);
  return refusal.message;
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

TEST(BedTable, has_the_columns_that_the_last_comment_to_name_them_has) {
  expect_two_grains("# y x r\n# made by x\n1.25 0.5 0.4\n-0.125 3 0.6\n", 3, 4);
  expect_two_grains("# x y r\n# y x r\n# units: D\n1.25 0.5 0.4\n-0.125 3 0.6\n# x y r\n", 4, 5);
}

TEST(BedTable, has_any_ends_of_lines_and_a_byte_order_mark) {
  expect_two_grains("\xef\xbb\xbfx,y,radius\r\n0.5,1.25,0.4 \t\r\n3,-0.125,0.6\r\n", 2, 3);
  expect_two_grains(
      "\xef\xbb\xbf"
      "0.5 1.25 0.4\n3 -0.125 0.6");
  expect_two_grains("x,y,radius\r0.5,1.25,0.4\r\r3,-0.125,0.6\r", 2, 4);
  for (const std::string mark : {"\xff\xfe", "\xfe\xff"})
    EXPECT_EQ(message_of(mark + "1,2,0.5\n"),
              "bed.csv: this is not a table in UTF-8: it is in UTF-16, or not text; save it as UTF-8 text");
  EXPECT_EQ(message_of(std::string("1\0,\0002\0", 6)),
            "bed.csv: this is not a table in UTF-8: it is in UTF-16, or not text; save it as UTF-8 text");
}

TEST(BedTable, has_its_columns_in_the_order_of_their_names) {
  expect_two_grains("x,y,r\n0.5,1.25,0.4\n3,-0.125,0.6\n", 2, 3);
  expect_two_grains("Diameter;Y;X\n0.8;1.25;0.5\n1.2;-0.125;3\n", 2, 3);
  expect_two_grains("\"x\",\"z\",'D'\n\"0.5\",\"1.25\",\"0.8\"\n3,-0.125,1.2\n", 2, 3);
  expect_two_grains("radius x z\n0.4 0.5 1.25\n0.6 3 -0.125\n", 2, 3);
  expect_two_grains("x,y,z,d\n0.5,1.25,0,0.8\n3,-0.125,0.0,1.2\n", 2, 3);
  expect_two_grains("# d y x\n0.8 1.25 0.5\n1.2 -0.125 3\n", 2, 3);
  expect_two_grains("# x and y of the grains\n0.5 1.25 0.4\n3 -0.125 0.6\n", 2, 3);
}

TEST(BedTable, skips_columns_that_are_no_part_of_a_grain) {
  expect_two_grains(",id,x,y,vx,r\n0,a,0.5,1.25,-,0.4\n1,b,3,-0.125,,0.6\n,,,,,\n", 2, 3);
  expect_two_grains("grain id\tx\ty\tr\tnote\n1\t0.5\t1.25\t0.4\t\n2\t3\t-0.125\t0.6\tlast one\n", 2, 3);
  expect_two_grains("ID Type X Y x_old R # as of today\n7 1 0.5 1.25 4 0.4\n8 1 3 -0.125 4 0.6\n", 2, 3);
}

TEST(BedTable, has_lengths_in_the_unit_that_is_named) {
  const std::string mm = "\n500,1250,400\n3000,-125,600\n";
  for (const char* names : {"x [mm],y [mm],radius [mm]", "x (mm),y(mm),r_mm", "x,y,r"})
    expect_two_grains(names + mm, 2, 3, scenario::LengthUnit::millimetre);
  for (const char* names : {"x [mm],y [mm],radius [mm]", "X/mm,Y mm,r_MM"})
    expect_two_grains(names + mm, 2, 3);
  expect_two_grains("x [m] z [cm] d [\xc2\xb5m]\n0.5 125 8e5\n3 -12.5 1.2e6\n", 2, 3);
  expect_two_grains("500 1250 400\n3000 -125 600\n", 1, 2, scenario::LengthUnit::millimetre);
  EXPECT_EQ(message_of("x [in],y,r\n1,2,1\n"),
            "bed.csv:1:1: error: the column \"x [in]\" has an unknown unit: expected D, m, cm, mm or um");
  const auto two_units = [] {
    parse_bed_table("x,y [m],r\n1,2,0.5\n", "bed.csv", {scenario::LengthUnit::millimetre});
  };
  EXPECT_EQ(
      test::refusal_of(two_units).message,
      "bed.csv:1:3: error: the column \"y [m]\" has a unit other than deposition.file_unit: omit one of "
      "them");
  EXPECT_EQ(in_metres(2.0, scenario::LengthUnit::mean_diameter, 0.01), 0.02);
}

TEST(BedTable, refuses_names_with_a_sentence_about_names) {
  const auto refused = [](const std::string& names, const std::string& fault) {
    return "bed.csv:1:1: error: the columns are named " + names + ", " + fault +
           ": expected x, y (or z) for the height, and r, radius, d or diameter, in any order; each may have "
           "a unit, as in x [mm]";
  };
  EXPECT_EQ(message_of("x,y,size\n1,2,0.5\n"), refused("\"x\", \"y\", \"size\"", "no column for the size"));
  EXPECT_EQ(message_of("a b c\n1 2 3\n"), refused("\"a\", \"b\", \"c\"", "no column for x"));
  EXPECT_EQ(message_of("x,\x1b[1m,r\n"), refused(R"("x", "\x1b[1m", "r")", "no column for the height"));
  EXPECT_EQ(message_of("x,y,r,d\n"),
            refused("\"x\", \"y\", \"r\", \"d\"", "more than one column for the size"));
  EXPECT_EQ(message_of("x,y,x,d\n"), refused("\"x\", \"y\", \"x\", \"d\"", "more than one column for x"));
  EXPECT_EQ(message_of("x,y,z,r\n1,2,3,0.5\n2,2,3,0.5\n1,3,4,0.5\n"),
            "bed.csv:4:1: error: this grain differs from others in both y and z: expected a bed of disks, "
            "with the same z (or the same y) for all; a section of a pile of spheres is not one");
  EXPECT_EQ(message_of("x,y,r,id\n1,2,0.5\n"),
            "bed.csv:2:1: error: the line has 3 values: expected 4, one for each column that line 1 names");
  EXPECT_EQ(
      message_of("x;y;r\n1,5;2;0,5\n"),
      "bed.csv:2:1: error: x = \"1,5\": expected a finite number with a decimal point, in mean diameters D");
}

TEST(BedTable, without_lines_has_no_grain) {
  for (const char* text : {"", "\n\n", "# nothing", "x,y,radius\n"})
    EXPECT_TRUE(parse_bed_table(text, "bed.csv", {}).grains.empty()) << text;
}

TEST(BedTable, tells_where_it_cannot_be_read) {
  const std::string number = ": expected a finite number, in mean diameters D";
  EXPECT_EQ(message_of("1,2,0.5\n1, two,0.5\n"), "bed.csv:2:4: error: y = \"two\"" + number);
  EXPECT_EQ(message_of("1,2,0.5\nx,y,radius\n"), "bed.csv:2:1: error: x = \"x\"" + number)
      << "names have priority";
  EXPECT_EQ(message_of("1 2 nan\n"), "bed.csv:1:5: error: radius = \"nan\"" + number);
  EXPECT_EQ(message_of("inf,2,1\n"), "bed.csv:1:1: error: x = \"inf\"" + number);
  EXPECT_EQ(message_of("1,1e999,1\n"), "bed.csv:1:3: error: y = \"1e999\"" + number);
  EXPECT_EQ(message_of("1,,1\n"), "bed.csv:1:3: error: y = \"\"" + number);
  EXPECT_EQ(message_of("1,2,0x1\n"), "bed.csv:1:5: error: radius = \"0x1\"" + number);
  EXPECT_EQ(message_of("1,2 3,4\n"), "bed.csv:1:3: error: y = \"2 3\"" + number);
}

TEST(BedTable, has_three_values_in_a_line) {
  const auto has = [](const std::string& count) {
    return "error: the line has " + count +
           " values: expected three, x, y and radius, or a first line that "
           "names the columns";
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
}  // namespace talus::session
