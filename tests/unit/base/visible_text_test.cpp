// Terminal control sequences are removed.

#include "base/visible_text.h"

#include <gtest/gtest.h>

namespace talus {
namespace {

TEST(VisibleText, is_what_it_was_without_controls) {
  EXPECT_EQ(visible("theta_c = 21\n \xc2\xb1 0.3 \xe2\x84\x93 \xf0\x9f\x8f\x94"),
            "theta_c = 21\n \xc2\xb1 0.3 \xe2\x84\x93 \xf0\x9f\x8f\x94");
  EXPECT_EQ(visible(""), "");
}

TEST(VisibleText, names_the_bytes_that_a_terminal_obeys) {
  EXPECT_EQ(visible("\x1b[2Ja\rb\a\x7f"), "\\x1b[2Ja\\x0db\\x07\\x7f");
  EXPECT_EQ(visible("\xc2\x9b"), "\\xc2\\x9b") << "CSI among the C1 control characters";
  EXPECT_EQ(visible("\xe2\x80\xae"), "\\xe2\\x80\\xae") << "reverses the direction of writing";
}

TEST(VisibleText, names_the_bytes_that_are_no_character) {
  EXPECT_EQ(visible("\xff z"), "\\xff z");
  EXPECT_EQ(visible("\xc0\x9b"), "\\xc0\\x9b") << "an overlong encoding";
  EXPECT_EQ(visible("\xe0\x81\x81"), "\\xe0\\x81\\x81") << "an A in three bytes";
  EXPECT_EQ(visible("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half of a UTF-16 surrogate pair";
  EXPECT_EQ(visible("a\xe2\x84"), "a\\xe2\\x84") << "truncated";
}

TEST(VisibleWord, is_one_line_and_short) {
  EXPECT_EQ(visible_word("plain text"), "plain text");
  EXPECT_EQ(visible_word("a\x1b[31m\n\x7f\xff"), "a\\x1b[31m\\x0a\\x7f\\xff");
  EXPECT_EQ(visible_word("\xd1\x80"
                         "eriodic"),
            "\\xd1\\x80eriodic")
      << "looks like periodic";
  EXPECT_EQ(visible_word(std::string(60, 'x')), std::string(60, 'x'));
  EXPECT_EQ(visible_word(std::string(61, 'x')), std::string(60, 'x') + "...");
  EXPECT_EQ(visible_word("caf\xc3\xa9s", 4), "caf\\xc3\\xa9...") << "characters are counted, not bytes";
}

TEST(Utf8, has_a_replacement_for_each_byte_that_is_none) {
  EXPECT_EQ(utf8("b\xc3\xb6\n\x1b"), "b\xc3\xb6\n\x1b");
  EXPECT_EQ(utf8("b\xf6"
                 "b\xe2\x84"),
            "b\xef\xbf\xbd"
            "b\xef\xbf\xbd\xef\xbf\xbd");
}

TEST(QuotedUtf8, escapes_what_a_terminal_obeys) {
  EXPECT_EQ(quoted_utf8("a\"b\\ \xc3\xb6\n"), "\"a\\\"b\\\\ \xc3\xb6\\u000a\"");
  EXPECT_EQ(quoted_utf8("\x1b \xc2\x9b \xe2\x80\xae \xf6"), "\"\\u001b \\u009b \\u202e \xef\xbf\xbd\"");
}

}  // namespace
}  // namespace talus
