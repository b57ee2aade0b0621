/// docs/file_format.md holds the table of data sets as the code has it.

#include <gtest/gtest.h>

#include <sstream>

#include "io/run_schema.h"
#include "support/places.h"
#include "unit/io/example_run.h"

namespace talus {
namespace {

std::string row_text(const DataSetField& field) {
  std::ostringstream row;
  row << "| `" << field.path << "` | " << type_name(field.type) << " | "
      << (field.shape.empty() ? "-" : field.shape) << " | " << field.unit << " | " << field.help << " |\n";
  return row.str();
}

TEST(FileFormat, is_documented_as_it_is) {
  std::string expected, found;
  for (const DataSetField& field : run_schema()) expected += row_text(field);
  std::istringstream page(example::file_text(test::source_folder() + "/docs/file_format.md"));
  for (std::string line; std::getline(page, line);)
    if (line.starts_with("| `/")) found += line + "\n";
  EXPECT_EQ(found, expected) << "the table of docs/file_format.md must be:\n" << expected;
}

TEST(FileFormat, every_path_stands_once) {
  std::map<std::string, int> times;
  for (const DataSetField& field : run_schema()) EXPECT_EQ(++times[field.path], 1) << field.path;
}

}  // namespace
}  // namespace talus
