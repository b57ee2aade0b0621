/// docs/export.md has the tables of the program.

#include <gtest/gtest.h>

#include <fmt/core.h>
#include <fstream>
#include <sstream>

#include "export/fields.h"
#include "export/formats.h"
#include "export/writers.h"
#include "support/places.h"

namespace talus::test {
namespace {

std::string page() {
  std::ifstream file(test::source_folder() + "/docs/export.md");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

const char* text_of(ExportOutput output) {
  switch (output) {
    case ExportOutput::folder:
      return "a folder";
    case ExportOutput::file:
      return "a file";
    case ExportOutput::file_per_frame:
      break;
  }
  return "a file, or a folder for several frames";
}

const char* text_of(FieldNumber number) {
  switch (number) {
    case FieldNumber::integer:
      return "integer";
    case FieldNumber::single:
      return "single";
    case FieldNumber::real:
      break;
  }
  return "double";
}

const char* text_of(FieldShape shape) {
  return shape == FieldShape::scalar ? "1" : shape == FieldShape::vector ? "x, y" : "xx, xy, yx, yy";
}

std::string rows_of(std::span<const GridField> fields) {
  std::string rows;
  for (const GridField& field : fields)
    rows += fmt::format("| `{}` | {} | {} | {} |\n", field.name, text_of(field.shape), field.unit,
                        field.definition);
  return rows;
}

std::string rows_of(std::span<const FrameQuantity> fields) {
  std::string rows;
  for (const FrameQuantity& field : fields)
    if (!field.name.empty() && is_of_frame(field))
      rows += fmt::format("| `{}{}` | {} | {} | {} | {} |\n", field.name,
                          field.need == FrameNeed::threshold ? "_FACTOR" : "", text_of(field.shape),
                          text_of(field.number), field.unit, field.definition);
  return rows;
}

TEST(ExportPage, lists_the_formats) {
  std::string rows;
  for (const FormatEntry& entry : export_formats())
    rows += fmt::format("| `{}` | {}{} | {} | {} |\n", entry.name, text_of(entry.output),
                        entry.ending.empty() ? "" : fmt::format(", `{}`", entry.ending), entry.program,
                        entry.help);
  EXPECT_NE(page().find("|---|---|---|---|\n" + rows + "\n"), std::string::npos) << rows;
}

TEST(ExportPage, lists_the_fields) {
  const std::string head = "|---|---|---|---|---|\n";
  EXPECT_NE(page().find(head + rows_of(grain_quantities()) + "\n"), std::string::npos)
      << rows_of(grain_quantities());
  EXPECT_NE(page().find(head + rows_of(contact_quantities()) + "\n"), std::string::npos)
      << rows_of(contact_quantities());
  EXPECT_NE(page().find("|---|---|---|---|\n" + rows_of(grid_fields()) + "\n"), std::string::npos)
      << rows_of(grid_fields());
}

}  // namespace
}  // namespace talus::test
