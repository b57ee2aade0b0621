/// Texts: words, numbers, tables, suggestions, and what a terminal may show.

#include "base/text.h"

#include <gtest/gtest.h>

#include <limits>
#include <new>
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

TEST(Base64, is_that_of_RFC_4648) {
  const std::pair<std::string, std::string> cases[] = {{"", ""},
                                                       {"f", "Zg=="},
                                                       {"fo", "Zm8="},
                                                       {"foo", "Zm9v"},
                                                       {"foob", "Zm9vYg=="},
                                                       {"fooba", "Zm9vYmE="},
                                                       {"foobar", "Zm9vYmFy"},
                                                       {"\xff\xfe\xfb", "//77"}};
  for (const auto& [bytes, text] : cases) EXPECT_EQ(base64(std::as_bytes(std::span(bytes))), text);
}

const std::vector<std::string> commands = {"run", "render", "repair", "replay", "solve", "dump", "figures"};

TEST(EditDistance, counts_insertions_deletions_and_replacements) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("abc", ""), 3u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("friction", "friction"), 0u);
  EXPECT_EQ(edit_distance("fricton", "friction"), 1u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("step", "pets"), 4u);
}

TEST(NearestWord, is_a_slip_of_the_hand_away) {
  EXPECT_EQ(nearest_word("rnu", commands), "run");
  EXPECT_EQ(nearest_word("Render", commands), "render");
  EXPECT_EQ(nearest_word("reprai", commands), "repair");
  EXPECT_EQ(nearest_word("figrues", commands), "figures");
  EXPECT_EQ(nearest_word("replay", commands), "replay");
}

TEST(NearestWord, may_be_cut_short_or_go_on) {
  EXPECT_EQ(nearest_word("fig", commands), "figures");
  EXPECT_EQ(nearest_word("render-all", commands), "render");
  EXPECT_EQ(nearest_word("runs", commands), "run");
}

TEST(NearestWord, is_none_where_nothing_is_near) {
  for (const char* word : {"", "r", "plot", "help", "gum", "measurements"})
    EXPECT_EQ(nearest_word(word, commands), "") << word;
  EXPECT_EQ(nearest_word(std::string(100000, 'r'), commands), "");
  EXPECT_EQ(nearest_word("run", {}), "");
}

TEST(DidYouMean, is_the_end_of_a_message) {
  EXPECT_EQ(did_you_mean("slove", commands), "; did you mean 'solve'?");
  EXPECT_EQ(did_you_mean("plot", commands), "");
}

TEST(TextStream, reads_what_the_text_has) {
  std::istringstream stream = text_stream("a b\nc");
  std::string line, end;
  std::getline(stream, line);
  EXPECT_EQ(line, "a b");
  EXPECT_TRUE(stream >> line);
  EXPECT_EQ(line, "c");
  EXPECT_FALSE(stream >> end) << "the end of the text is not an error";
}

/// Buffer in which every read fails for lack of memory.
class NoMemory : public std::stringbuf {
  int_type underflow() override { throw std::bad_alloc(); }
};

TEST(TextStream, throws_where_memory_is_missing) {
  NoMemory buffer;
  std::istringstream stream = text_stream("");
  stream.std::ios::rdbuf(&buffer);
  stream.exceptions(text_stream("").exceptions());
  std::string line;
  EXPECT_THROW(std::getline(stream, line), std::bad_alloc);
  std::istringstream plain;
  plain.std::ios::rdbuf(&buffer);
  EXPECT_NO_THROW(std::getline(plain, line)) << "the reason";
}

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
