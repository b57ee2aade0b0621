/// docs/file_format.md and the Python package agree with the table of data sets in the code.

#include <gtest/gtest.h>

#include <algorithm>
#include <fmt/core.h>
#include <fstream>
#include <sstream>

#include "io/run_schema.h"
#include "support/places.h"
#include "unit/io/example_run.h"

namespace talus::io {
namespace {

/// Returns whether the page describes a data set of /branch under /checkpoint.
bool is_of_checkpoint(const DataSetField& field) {
  return field.path.starts_with("/branch/") &&
         std::ranges::any_of(run_schema(), [&](const DataSetField& other) {
           return other.path == "/checkpoint" + field.path.substr(7) && other.type == field.type &&
                  other.unit == field.unit && other.help == field.help;
         });
}

TEST(FileFormat, is_documented_as_it_is) {
  std::string expected, found;
  for (const DataSetField& field : run_schema())
    if (!is_of_checkpoint(field)) expected += example::row_text(field);
  std::istringstream page(test::text_of(test::source_folder() + "/docs/file_format.md"));
  for (std::string line; std::getline(page, line);)
    if (line.starts_with("| `/")) found += line + "\n";
  EXPECT_EQ(found, expected) << "the table of docs/file_format.md must be:\n" << expected;
}

constexpr const char* schema_for_python =
    R"("""Table of every data set of a run file and of its analysis. The test FileFormat of unit_io generates it from the table of
the program, compares the two, and reports where the generated one is."""

#: Versions of the tables in docs/file_format.md and docs/analysis.md.
SCHEMA = {}
ANALYSIS = {}

#: Type, shape and unit by the path without its first slash; `*` stands for names that depend on the run. Letters of a
#: shape are sizes (docs/file_format.md).
DATA_SETS = {{
)";

TEST(FileFormat, is_what_the_python_package_checks) {
  std::ostringstream table;
  table << fmt::format(schema_for_python, run_schema_version, analysis_version);
  for (const std::vector<DataSetField>& schema : {run_schema(), analysis_schema()})
    for (const DataSetField& field : schema)
      table << "    \"" << field.path.substr(1) << "\": (\"" << type_name(field.type) << "\", \""
            << field.shape << "\", \"" << field.unit << "\"),\n";
  table << "}\n";
  const std::string written = test::build_folder() + "/schema.py";
  std::ofstream(written) << table.str();
  EXPECT_TRUE(test::text_of(test::source_folder() + "/python/talus/schema.py") == table.str())
      << "python/talus/schema.py must be equal to " << written;
}

TEST(FileFormat, every_path_stands_once) {
  std::map<std::string, int> times;
  for (const DataSetField& field : run_schema()) EXPECT_EQ(++times[field.path], 1) << field.path;
}

}  // namespace
}  // namespace talus::io
