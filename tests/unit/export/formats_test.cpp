#include "export/formats.h"

#include <gtest/gtest.h>

#include "export/export_files.h"
#include "support/exit_code.h"

namespace talus::test {
namespace {

TEST(Formats, are_known_by_their_names) {
  for (const FormatEntry& entry : export_formats()) {
    EXPECT_EQ(export_format(entry.name), entry.format);
    EXPECT_EQ(entry_of(entry.format).name, entry.name);
    EXPECT_NE(list_of_formats().find(std::string(entry.name) + ": "), std::string::npos);
    EXPECT_EQ(entry.ending.empty(), entry.output == ExportOutput::folder) << entry.name;
  }
  EXPECT_FALSE(export_format("paravie").has_value());
}

TEST(Formats, name_their_files_by_the_numbers_of_frames) {
  const std::vector<std::string> files = files_of({ExportFormat::paraview, "out", {3, 12345}, {}});
  EXPECT_EQ(files,
            (std::vector<std::string>{"out/grains.pvd", "out/contacts.pvd", "out/frames/grains_0003.vtp",
                                      "out/frames/contacts_0003.vtp", "out/frames/grains_12345.vtp",
                                      "out/frames/contacts_12345.vtp"}));
}

}  // namespace
}  // namespace talus::test
