/// The tables of docs/export.md and of the quantities in docs/python.md agree with the program.

#include <gtest/gtest.h>

#include <fmt/core.h>
#include <fstream>
#include <sstream>

#include "exports/fields.h"
#include "exports/formats.h"
#include "exports/writers.h"
#include "support/places.h"

namespace talus::test {
namespace {

std::string page(const std::string& name = "export") {
  std::ifstream file(test::source_folder() + "/docs/" + name + ".md");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
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
    rows += fmt::format("| `{}` | {}{} | {} | {} |\n", entry.name, text_of(entry.output),
                        entry.ending.empty() ? "" : fmt::format(", `{}`", entry.ending), entry.program,
                        entry.help);
  EXPECT_NE(page().find("|---|---|---|---|\n" + rows + "\n"), std::string::npos) << rows;
}

TEST(ExportPage, lists_the_fields) {
  const std::string head = "|---|---|---|---|---|\n";
  EXPECT_NE(page().find(head + rows_of(analysis::grain_quantities()) + "\n"), std::string::npos)
      << rows_of(analysis::grain_quantities());
  EXPECT_NE(page().find(head + rows_of(analysis::contact_quantities()) + "\n"), std::string::npos)
      << rows_of(analysis::contact_quantities());
  EXPECT_NE(page().find("|---|---|---|---|\n" + rows_of(exports::grid_fields()) + "\n"), std::string::npos)
      << rows_of(exports::grid_fields());
}

TEST(PythonPage, lists_the_quantities_that_no_export_has) {
  std::string rows;
  for (const analysis::FrameQuantity& quantity : analysis::grain_quantities())
    if (!analysis::is_of_frame(quantity))
      rows += fmt::format("| `{}` | {} | {} |\n", quantity.name, quantity.unit, quantity.definition);
  EXPECT_NE(page("python").find("|---|---|---|\n" + rows + "\n"), std::string::npos) << rows;
}

}  // namespace
}  // namespace talus::test
