#include <gtest/gtest.h>

#include <set>

#include "base/errors.h"
#include "exports/writers.h"
#include "support/exit_code.h"
#include "unit/exports/example_frame.h"

namespace talus::test {
namespace {

TEST(Vti, has_an_array_for_each_field_with_its_unit) {
  const ExampleFrame example = example_frame();
  const std::string text = exports::fields_vti(example.source(), 0.5);
  std::set<std::string_view> names;
  for (const exports::GridField& field : exports::grid_fields()) {
    names.insert(field.name);
    const std::string array = "Float32\" Name=\"" + std::string(field.name) + "\"";
    EXPECT_NE(text.find(array), std::string::npos) << array;
  }
  EXPECT_EQ(names.size(), exports::grid_fields().size());
  EXPECT_NE(text.find(">N/m^3</InformationKey>"), std::string::npos);
  EXPECT_NE(text.find("<ImageData WholeExtent=\"0 19 0 "), std::string::npos) << text.substr(0, 600);
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

}  // namespace
}  // namespace talus::test
