/// Exact text output of the writers for one frame.

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "exports/writers.h"
#include "unit/exports/example_frame.h"

namespace talus::test {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string number(double value, analysis::FieldNumber kind) {
  std::string text;
  analysis::append_number(text, value, kind);
  return text;
}

TEST(NumberText, is_the_shortest_that_reads_back) {
  EXPECT_EQ(number(0.1 + 0.2, analysis::FieldNumber::real), "0.30000000000000004");
  EXPECT_EQ(number(static_cast<double>(0.1F), analysis::FieldNumber::single), "0.1");
  EXPECT_EQ(number(-3.0, analysis::FieldNumber::integer), "-3");
  EXPECT_EQ(number(2147483647.0, analysis::FieldNumber::integer), "2147483647");
  EXPECT_EQ(number(std::numeric_limits<double>::quiet_NaN(), analysis::FieldNumber::single), "nan");
  for (double value = 1.0; value > 1e-300; value *= 0.0123)
    EXPECT_EQ(std::stod(number(value, analysis::FieldNumber::real)), value);
  for (double value = 1.0; value > 1e-37; value *= 0.0123)
    EXPECT_EQ(std::stof(number(value, analysis::FieldNumber::single)), static_cast<float>(value));
}

TEST(Xyz, has_a_box_and_lengths_in_mean_diameters) {
  const ExampleFrame example = example_frame();
  const std::vector<std::string> lines = lines_of(exports::xyz_text(example.source()));
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines[0], "3");
  EXPECT_EQ(
      lines[1].find(
          "Lattice=\"8 0 0 0 2.8 0 0 0 1\" Origin=\"0 -0.9 -0.5\" Properties=species:S:1:pos:R:3:id:I:1:"
          "kind:I:1:radius:R:1:"),
      0U)
      << lines[1];
  EXPECT_NE(lines[1].find(":image:I:3:velo:R:3:"), std::string::npos);
  EXPECT_NE(lines[1].find(":overloaded_1_5:I:1:lc_1:R:1:"), std::string::npos) << lines[1];
  EXPECT_NE(
      lines[1].find(
          " pbc=\"T F F\" Time=0.1 tilt=0.25 step=1200 frame=7 mean_diameter=0.125 units=\"lengths in "),
      std::string::npos)
      << lines[1];
  EXPECT_EQ(lines[2].find("X 7.5 1.5 0 0 1 0.4 1 -1 0 0 0.5 -1 0 0 2 -"), 0U) << lines[2];
  EXPECT_EQ(lines[4].find("X 4 -0.5 0 2 2 0.4 "), 0U) << lines[4];
}

TEST(LammpsDump, has_the_items_of_a_frame) {
  const ExampleFrame example = example_frame();
  const std::vector<std::string> lines = lines_of(exports::lammps_dump_text(example.source()));
  ASSERT_EQ(lines.size(), 14U);
  const std::vector<std::string> head = {"ITEM: TIME",
                                         "0.1",
                                         "ITEM: TIMESTEP",
                                         "1200",
                                         "ITEM: NUMBER OF ATOMS",
                                         "3",
                                         "ITEM: BOX BOUNDS pp ff ff",
                                         "0 1"};
  EXPECT_EQ(std::vector(lines.begin(), lines.begin() + 8), head);
  EXPECT_EQ(lines[9], "-0.0625 0.0625");
  EXPECT_EQ(lines[10].find(
                "ITEM: ATOMS id type x y radius mass ix iy vx vy angle omegaz displacementx displacementy "
                "internal_moment_xx "),
            0U)
      << lines[10];
  EXPECT_EQ(lines[11].find("0 1 0.9375 0.1875 0.05 1 -1 0 0.5 -1 0 2 -"), 0U) << lines[11];
  EXPECT_EQ(lines[12].substr(lines[12].size() - 6), " -1 -1");
}

TEST(Csv, names_units_and_leaves_fields_empty_without_a_number) {
  const ExampleFrame example = example_frame();
  const analysis::GrainSource frame = example.source();
  EXPECT_EQ(exports::frame_csv(frame).rows, "7,1200,0.1,0.25\n");
  const exports::CsvRows grains = exports::grains_csv(frame), contacts = exports::contacts_csv(frame);
  EXPECT_EQ(
      grains.head.find("frame,id,type,x (m),y (m),radius (m),mass (kg/m),image_x,image_y,velocity_x (m/s),"),
      0U)
      << grains.head;
  const std::vector<std::string> rows = lines_of(grains.rows);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].find("7,0,1,0.9375,0.1875,0.05,1,-1,0,0.5,-1,0,2,"), 0U) << rows[0];
  EXPECT_NE(rows[0].find(",0.6,0.5,1,0,1.118034,0.5,,1,0,0.5,,0,-1"), std::string::npos) << rows[0];
  EXPECT_EQ(
      contacts.head,
      "frame,a,b,shift,point_x (m),point_y (m),normal_x,normal_y,normal_force (N/m),tangential_force (N/m),"
      "mobilisation,status,strong\n");
  EXPECT_EQ(contacts.rows,
            "7,0,1,1,1,0.125,1,0,4,-1,0.5,1,1\n7,1,2,0,0.25,0,0,-1,1,0.5,1,2,0\n7,1,3,0,0.03125,0,0,-1,1,0,0,"
            "1,0\n");
}

TEST(Csv, of_observables_has_a_row_for_each_time) {
  ObservableRow row{};
  at(row, Observable::time) = 0.1 + 0.2;
  at(row, Observable::sigma_t_over_n) = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::string> lines = lines_of(exports::observables_csv(std::vector{row, row}));
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0].find("step,time (s),tilt (rad),sigma_n (Pa),sigma_t (Pa),sigma_t_over_n,"), 0U)
      << lines[0];
  EXPECT_EQ(lines[1].find("0,0.30000000000000004,0,0,0,,0,"), 0U) << lines[1];
}

}  // namespace
}  // namespace talus::test
