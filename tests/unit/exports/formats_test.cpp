#include "exports/formats.h"

#include <gtest/gtest.h>

#include <utility>

#include "exports/export_files.h"
#include "support/exit_code.h"

namespace talus::test {
namespace {

TEST(Formats, are_known_by_their_names) {
  for (const exports::FormatEntry& entry : exports::export_formats()) {
    EXPECT_EQ(exports::export_format(entry.name), entry.format);
    EXPECT_EQ(exports::entry_of(entry.format).name, entry.name);
    EXPECT_NE(exports::list_of_formats().find(std::string(entry.name) + ": "), std::string::npos);
    EXPECT_EQ(entry.ending.empty(), entry.output == exports::ExportOutput::folder) << entry.name;
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

}  // namespace
}  // namespace talus::test
