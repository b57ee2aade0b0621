#include "base/text.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace talus {
namespace {

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

}  // namespace
}  // namespace talus
