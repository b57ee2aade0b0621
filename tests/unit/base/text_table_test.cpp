/// Tables as aligned text and CSV.

#include "base/text_table.h"

#include <gtest/gtest.h>

#include <cmath>

namespace talus {
namespace {

const TextTable small = {{{"bed"}, {"θ", true, "deg"}, {"p_o", true, "", "2 Gamma_c"}, {""}},
                         {{{"poured"}, {"9.5"}, {"0.25"}, {"failed"}}, {{"set"}, {"10.25"}}}};

TEST(TextTable, aligns_its_columns_under_their_groups_and_above_their_units) {
  EXPECT_EQ(aligned_text(small, 1),
            "               | 2 Gamma_c\n"
            " bed         θ |  p_o\n"
            "           deg |\n"
            " poured    9.5 | 0.25  failed\n"
            " set     10.25 |\n");
  EXPECT_EQ(aligned_text({{{"a"}, {"b", true}}, {{{"x"}, {"1"}}}}), "a  b\nx  1\n")
      << "no lines without texts";
}

TEST(TextTable, is_csv_with_titles_or_without) {
  EXPECT_EQ(csv_text(small), "bed,θ,p_o,\npoured,9.5,0.25,failed\nset,10.25\n");
  EXPECT_EQ(csv_text(small, false), "poured,9.5,0.25,failed\nset,10.25\n");
}

TEST(TextTable, has_numbers_by_their_format_and_a_dash_for_none) {
  EXPECT_EQ(number_cell("{:+.2f}", 1.5), "+1.50");
  EXPECT_EQ(number_cell("{:+.2f}", -0.001), "+0.00");
  EXPECT_EQ(number_cell("{:.2f}", -0.001), "0.00");
  EXPECT_EQ(number_cell("{:.2f}", -10.0), "-10.00");
  EXPECT_EQ(number_cell("{:.2f}", std::nan("")), "-");
}

}  // namespace
}  // namespace talus
