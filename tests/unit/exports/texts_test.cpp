/// Exports as text and for ParaView.

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <sstream>

#include "base/errors.h"
#include "exports/writers.h"
#include "support/exit_code.h"
#include "support/has.h"
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
  EXPECT_TRUE(has_all(
      lines[1],
      {":image:I:3:velo:R:3:", ":overloaded_1_5:I:1:lc_1:R:1:",
       " pbc=\"T F F\" Time=0.1 tilt=0.25 step=1200 frame=7 mean_diameter=0.125 units=\"lengths in "}));
  EXPECT_EQ(lines[2].find("X 7.5 1.5 0 0 1 0.4 1 -1 0 0 0.5 -1 0 0 2 -"), 0U) << lines[2];
  EXPECT_EQ(lines[4].find("X 4 -0.5 0 2 2 0.4 "), 0U) << lines[4];
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
  EXPECT_TRUE(has(rows[0], ",0.6,0.5,1,0,1.118034,0.5,,1,0,0.5,,0,-1"));
  EXPECT_EQ(
      contacts.head,
      "frame,a,b,shift,point_x (m),point_y (m),normal_x,normal_y,normal_force (N/m),tangential_force (N/m),"
      "mobilisation,status,strong\n");
  EXPECT_EQ(contacts.rows,
            "7,0,1,1,1,0.125,1,0,4,-1,0.5,1,1\n7,1,2,0,0.25,0,0,-1,1,0.5,1,2,0\n7,1,3,0,0.03125,0,0,-1,1,0,0,"
            "1,0\n");
}

TEST(Vti, has_an_array_for_each_field_with_its_unit) {
  const ExampleFrame example = example_frame();
  const std::string text = exports::fields_vti(example.source(), 0.5);
  std::set<std::string_view> names;
  for (const exports::GridField& field : exports::grid_fields()) {
    names.insert(field.name);
    const std::string array = "Float32\" Name=\"" + std::string(field.name) + "\"";
    EXPECT_TRUE(has(text, array)) << array;
  }
  EXPECT_EQ(names.size(), exports::grid_fields().size());
  EXPECT_TRUE(has(text, ">N/m^3</InformationKey>"));
  EXPECT_TRUE(has(text, "<ImageData WholeExtent=\"0 19 0 ")) << text.substr(0, 600);
}

TEST(Vti, grid_goes_once_around_the_period_and_beyond_walls) {
  ExampleFrame example = example_frame();
  const exports::FieldGrid around =
      exports::field_grid(example.source(), 0.3);  // the period of 1 m is divided into 34 points, not 33.3
  EXPECT_EQ(around.columns, 34);
  EXPECT_DOUBLE_EQ(around.dx, 1.0 / 34.0);
  EXPECT_DOUBLE_EQ(around.x, 0.5 / 34.0);
  example.statics.periodic = false;
  const exports::FieldGrid walled = exports::field_grid(example.source(), 0.5);
  EXPECT_EQ(walled.columns, 30);
  EXPECT_DOUBLE_EQ(walled.x - 0.5 * walled.dx, -0.25);
  EXPECT_DOUBLE_EQ(walled.y - 0.5 * walled.dy, -0.0625 - 0.05 - 0.25) << "below the floor grain";
  EXPECT_GE(walled.y + (walled.rows - 0.5) * walled.dy, 0.1875 + 0.05 + 0.25 - 1e-12);
}

TEST(Vti, width_is_that_of_the_bed_at_most) {
  const ExampleFrame example = example_frame();
  for (const double width : {0.0, -1.0, 1.01, std::nan("")})
    EXPECT_EQ(test::exit_code_of([&] { exports::fields_vti(example.source(), width); }), ExitCode::usage)
        << width;
}

TEST(Vtp, has_an_array_for_each_field_with_its_unit) {
  const ExampleFrame example = example_frame();
  const std::string grains = exports::grains_vtp(example.source()),
                    contacts = exports::contacts_vtp(example.source());
  EXPECT_TRUE(has(grains, "NumberOfPoints=\"3\" NumberOfVerts=\"3\" NumberOfLines=\"0\""));
  EXPECT_TRUE(has(contacts, "NumberOfPoints=\"6\" NumberOfVerts=\"0\" NumberOfLines=\"3\""));
  for (const char* array : {"Int32\" Name=\"id\"", "Float64\" Name=\"radius\"", "Float32\" Name=\"velocity\"",
                            "Float32\" Name=\"lc_1_5\"", "Int32\" Name=\"cluster_1\""})
    EXPECT_EQ(count_of(grains, std::string("type=\"") + array), 1u) << array;
  EXPECT_EQ(count_of(contacts, "Name=\"normal_force\""), 2u) << "for points and for cells";
  EXPECT_EQ(count_of(grains, ">J/m</InformationKey>"), 1u);
}

}  // namespace
}  // namespace talus::test
