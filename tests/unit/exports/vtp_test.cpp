#include <gtest/gtest.h>

#include "exports/writers.h"
#include "unit/exports/example_frame.h"

namespace talus::test {
namespace {

/// Counts the occurrences of a part.
int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(Vtp, has_an_array_for_each_field_with_its_unit) {
  const ExampleFrame example = example_frame();
  const std::string grains = exports::grains_vtp(example.source()),
                    contacts = exports::contacts_vtp(example.source());
  EXPECT_NE(grains.find("NumberOfPoints=\"3\" NumberOfVerts=\"3\" NumberOfLines=\"0\""), std::string::npos);
  EXPECT_NE(contacts.find("NumberOfPoints=\"6\" NumberOfVerts=\"0\" NumberOfLines=\"3\""), std::string::npos);
  for (const char* array : {"Int32\" Name=\"id\"", "Float64\" Name=\"radius\"", "Float32\" Name=\"velocity\"",
                            "Float32\" Name=\"lc_1_5\"", "Int32\" Name=\"cluster_1\""})
    EXPECT_EQ(count_of(grains, std::string("type=\"") + array), 1) << array;
  EXPECT_EQ(count_of(contacts, "Name=\"normal_force\""), 2) << "for points and for cells";
  EXPECT_EQ(count_of(grains, ">J/m</InformationKey>"), 1);
}

TEST(Vtp, series_lists_files_over_time) {
  const std::vector<exports::PvdEntry> entries = {{0.5, "frames/a.vtp"}, {0.1 + 0.2, "frames/b.vtp"}};
  const std::string text = exports::pvd_text(entries);
  EXPECT_NE(text.find("<DataSet timestep=\"0.5\" part=\"0\" file=\"frames/a.vtp\"/>"), std::string::npos)
      << text;
  EXPECT_NE(text.find("timestep=\"0.30000000000000004\""), std::string::npos) << "times are exact";
}

}  // namespace
}  // namespace talus::test
