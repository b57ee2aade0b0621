/// Suggestions ("did you mean").

#include "base/nearest_word.h"

#include <gtest/gtest.h>

namespace talus {
namespace {

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

}  // namespace
}  // namespace talus
