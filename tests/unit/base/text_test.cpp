#include "base/text.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace talus {
namespace {

TEST(Text, numbers_have_their_plural) {
  EXPECT_EQ(counted(0, "command"), "0 commands");
  EXPECT_EQ(counted(1, "command"), "1 command");
  EXPECT_EQ(counted(2, "command"), "2 commands");
}

TEST(Text, items_are_joined) {
  EXPECT_EQ(joined(std::vector<std::string>{}, ", "), "");
  EXPECT_EQ(joined(std::vector<std::string>{"", "b"}, ", "), ", b");
  EXPECT_EQ(joined(std::vector{1, 2, 3}, " and "), "1 and 2 and 3");
  EXPECT_EQ(
      joined(std::vector{1, 2}, "+", [](int k) { return std::string(static_cast<std::size_t>(k), 'x'); }),
      "x+xx");
}

TEST(Text, a_word_is_quoted_as_a_shell_reads_it) {
  EXPECT_EQ(shell_quoted("runs/a-1_b.h5"), "runs/a-1_b.h5");
  EXPECT_EQ(shell_quoted("my run.h5"), "'my run.h5'");
  EXPECT_EQ(shell_quoted("it's $HOME"), "'it'\\''s $HOME'");
  EXPECT_EQ(shell_quoted(""), "''");
  EXPECT_EQ(shell_quoted("b\xf6 it's\n\\"), "$'b\\xf6 it\\'s\\x0a\\\\'") << "quoted for bash";
}

TEST(Text, of_a_number_that_rounds_to_0_has_no_sign) {
  EXPECT_EQ(fixed_text(-0.004, 2), "0.00");
  EXPECT_EQ(fixed_text(-0.0, 3), "0.000");
  EXPECT_EQ(fixed_text(-0.006, 2), "-0.01");
  EXPECT_EQ(fixed_text(-10.0, 0), "-10");
  EXPECT_EQ(fixed_text(-std::numeric_limits<double>::infinity(), 2), "-inf");
  EXPECT_EQ(degrees_text(-1e-17, 3), "0.000");
  EXPECT_EQ(degrees_text(-std::numbers::pi / 2.0, 1), "-90.0");
}

}  // namespace
}  // namespace talus
