/// Formats and fields of exports, and their page.

#include <gtest/gtest.h>

#include <algorithm>
#include <fmt/core.h>
#include <set>
#include <utility>

#include "exports/export_files.h"
#include "exports/writers.h"
#include "io/run_schema.h"
#include "support/exit_code.h"
#include "support/has.h"
#include "support/places.h"
#include "support/process.h"
#include "unit/exports/example_frame.h"

namespace talus::test {
namespace {

TEST(Formats, are_known_by_their_names) {
  for (const exports::FormatEntry& entry : exports::export_formats()) {
    EXPECT_EQ(exports::export_format(entry.name), entry.format);
    EXPECT_EQ(exports::entry_of(entry.format).name, entry.name);
    EXPECT_NE(exports::list_of_formats().find(std::string(entry.name) + ": "), std::string::npos);
    EXPECT_TRUE(entry.ending.starts_with('.')) << entry.name;
  }
  EXPECT_FALSE(exports::export_format("paravie").has_value());
}

TEST(Formats, of_one_file_have_its_ending) {
  EXPECT_EQ(exit_code_of([] { exports::check_output_name(exports::ExportFormat::xyz, "a.dump"); }),
            ExitCode::usage);
  EXPECT_EQ(exit_code_of([] { exports::check_output_name(exports::ExportFormat::lammps, "a.dump"); }),
            ExitCode::done);
  EXPECT_EQ(exit_code_of([] { exports::check_output_name(exports::ExportFormat::paraview, "a.dump"); }),
            ExitCode::done);
  EXPECT_EQ(exit_code_of([] { exports::check_output_name(exports::ExportFormat::csv, "a.csv"); }),
            ExitCode::usage);
  EXPECT_EQ(exit_code_of([] { exports::check_output_name(exports::ExportFormat::html, "a.htm"); }),
            ExitCode::usage);
}

TEST(Formats, name_their_files_by_the_numbers_of_frames) {
  using Files = std::vector<std::string>;
  const auto files = [](exports::ExportFormat format, const std::string& output,
                        std::vector<std::size_t> frames) {
    exports::ExportPlan plan;
    plan.format = format;
    plan.output = output;
    plan.frames = std::move(frames);
    return exports::files_of(plan);
  };
  EXPECT_EQ(files(exports::ExportFormat::csv, "out", {0, 3}),
            (Files{"out/frames.csv", "out/grains.csv", "out/contacts.csv"}));
  EXPECT_EQ(files(exports::ExportFormat::xyz, "a.xyz", {0, 3}), Files{"a.xyz"});
  EXPECT_EQ(files(exports::ExportFormat::html, "a.html", {0, 3}), Files{"a.html"});
  EXPECT_EQ(files(exports::ExportFormat::paraview, "out", {3, 12345}),
            (Files{"out/grains.pvd", "out/contacts.pvd", "out/frames/grains_0003.vtp",
                   "out/frames/contacts_0003.vtp", "out/frames/grains_12345.vtp",
                   "out/frames/contacts_12345.vtp"}));
}

std::string page(const std::string& name = "export") {
  return test::text_of(test::source_folder() + "/docs/" + name + ".md");
}

const char* text_of(exports::ExportOutput output) {
  return output == exports::ExportOutput::folder ? "a folder" : "a file";
}

const char* text_of(analysis::FieldNumber number) {
  switch (number) {
    case analysis::FieldNumber::integer:
      return "integer";
    case analysis::FieldNumber::single:
      return "single";
    case analysis::FieldNumber::real:
      break;
  }
  return "double";
}

const char* text_of(analysis::FieldShape shape) {
  return shape == analysis::FieldShape::scalar   ? "1"
         : shape == analysis::FieldShape::vector ? "x, y"
                                                 : "xx, xy, yx, yy";
}

std::string rows_of(std::span<const exports::GridField> fields) {
  std::string rows;
  for (const exports::GridField& field : fields)
    rows += fmt::format("| `{}` | {} | {} | {} |\n", field.name, text_of(field.shape), field.unit,
                        field.definition);
  return rows;
}

std::string rows_of(std::span<const analysis::FrameQuantity> fields) {
  std::string rows;
  for (const analysis::FrameQuantity& field : fields)
    if (!field.name.empty() && analysis::is_of_frame(field))
      rows += fmt::format("| `{}{}` | {} | {} | {} | {} |\n", field.name,
                          field.need == analysis::FrameNeed::threshold ? "_FACTOR" : "", text_of(field.shape),
                          text_of(field.number), field.unit, field.definition);
  return rows;
}

TEST(ExportPage, lists_the_formats) {
  std::string rows;
  for (const exports::FormatEntry& entry : exports::export_formats())
    rows +=
        fmt::format("| `{}` | {}{} | {} | {} |\n", entry.name, text_of(entry.output),
                    entry.output == exports::ExportOutput::folder ? "" : fmt::format(", `{}`", entry.ending),
                    entry.program, entry.help);
  EXPECT_TRUE(has(page(), "|---|---|---|---|\n" + rows + "\n")) << rows;
}

TEST(ExportPage, lists_the_fields) {
  const std::string head = "|---|---|---|---|---|\n";
  EXPECT_TRUE(has(page(), head + rows_of(analysis::grain_quantities()) + "\n"))
      << rows_of(analysis::grain_quantities());
  EXPECT_TRUE(has(page(), head + rows_of(analysis::contact_quantities()) + "\n"))
      << rows_of(analysis::contact_quantities());
  EXPECT_TRUE(has(page(), "|---|---|---|---|\n" + rows_of(exports::grid_fields()) + "\n"))
      << rows_of(exports::grid_fields());
}

TEST(PythonPage, lists_the_quantities_that_no_export_has) {
  std::string rows;
  for (const analysis::FrameQuantity& quantity : analysis::grain_quantities())
    if (!analysis::is_of_frame(quantity))
      rows += fmt::format("| `{}` | {} | {} |\n", quantity.name, quantity.unit, quantity.definition);
  EXPECT_TRUE(has(page("python"), "|---|---|---|\n" + rows + "\n")) << rows;
}

using Values = std::vector<double>;

class Fields : public testing::Test {
 protected:
  Values grain(const std::string& name) {
    for (const exports::FieldColumn& column : exports::grain_columns(frame_))
      if (column.name() == name) return column.values;
    ADD_FAILURE() << "no field " << name;
    return {};
  }

  ExampleFrame example_ = example_frame();
  analysis::GrainSource frame_ = example_.source();
};

TEST_F(Fields, of_thresholds_are_there_for_each_of_them) {
  EXPECT_EQ(grain("overloaded_1"), (Values{1, 0, 0}));
  EXPECT_EQ(grain("overloaded_1_5"), (Values{0, 0, 0}));
  EXPECT_EQ(grain("cluster_1"), (Values{0, -1, -1}));
  EXPECT_EQ(grain("lc_1")[0], 0.5);
  frame_.thresholds = {};
  for (const exports::FieldColumn& column : exports::grain_columns(frame_))
    EXPECT_NE(column.field.need, analysis::FrameNeed::threshold);
}

TEST_F(Fields, have_as_many_values_as_components_and_names_of_their_own) {
  for (const auto& [columns, rows] :
       {std::pair(exports::grain_columns(frame_), 3U), std::pair(exports::contact_columns(frame_), 3U)}) {
    std::set<std::string> names;
    for (const exports::FieldColumn& column : columns) {
      EXPECT_EQ(column.values.size(), rows * analysis::components(column.field)) << column.name();
      EXPECT_EQ(exports::component_names(column).size(), analysis::components(column.field)) << column.name();
      for (const std::string& name : exports::component_names(column))
        EXPECT_TRUE(names.insert(name).second) << name;
    }
  }
}

/// SI values have the unit in the attribute of their data set: per metre of thickness.
TEST_F(Fields, have_the_units_of_the_run_file) {
  const std::pair<const char*, const char*> same[] = {
      {"mass", "/particles/grains/mass"},
      {"velocity", "/particles/grains/velocity/value"},
      {"angular_velocity", "/particles/grains/angular_velocity/value"},
      {"internal_moment", "/particles/grains/internal_moment/value"},
      {"pressure", "/observables/sigma_n"}};
  for (const auto& [name, data_set] : same)
    EXPECT_EQ(std::ranges::find(analysis::grain_quantities(), name, &analysis::FrameQuantity::name)->unit,
              io::field_of(data_set).unit)
        << name;
  const std::pair<const char*, const char*> per_metre[] = {{"/contacts/force", "N/m"},
                                                           {"/observables/kinetic_energy", "J/m"},
                                                           {"/particles/grains/internal_moment/value", "J/m"},
                                                           {"/particles/grains/mass", "kg/m"},
                                                           {"/checkpoint/contact_force", "N/m"},
                                                           {"/branch/contact_force", "N/m"},
                                                           {"/branch/mass", "kg/m"}};
  for (const auto& [data_set, unit] : per_metre) EXPECT_EQ(io::field_of(data_set).unit, unit) << data_set;
}

}  // namespace
}  // namespace talus::test
