/// Files are small, finished, and free of paths of the machine on which they were written.

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "unit/house/source_tree.h"

namespace talus::house {
namespace {

const std::vector<std::string> everything = {".",      ".ci",   "src",  "render", "shaders", "tests",
                                             "assets", "bench", "docs", "cmake",  "python"};

/// Returns whether `line` contains an absolute path below the top folder `name`; "work/" inside a longer path
/// does not count.
bool has_path_below(std::string_view line, std::string_view name) {
  for (auto at = line.find(name); at != std::string_view::npos; at = line.find(name, at + 1)) {
    const auto end = at + name.size();
    const bool between_slashes = at > 0 && line[at - 1] == '/' && end < line.size() && line[end] == '/';
    const bool absolute =
        at < 2 || std::string_view(" \t\"'`=:(<[").find(line[at - 2]) != std::string_view::npos;
    if (between_slashes && absolute) return true;
  }
  return false;
}

TEST(Texts, sources_have_at_most_500_lines) {
  for (const TextFile& file : read_texts({"src", "render", "shaders", "tests", "bench"}))
    if (is_source(file)) {
      EXPECT_LE(file.lines.size(), 500u) << file.path << ": look for a second subject in it";
    }
}

TEST(Texts, hold_no_machine_path) {
  const auto texts = read_texts(everything);
  EXPECT_GT(texts.size(), 20u) << "the files were not found";
  for (const TextFile& file : texts)
    for (std::size_t i = 0; i < file.lines.size(); ++i)
      for (std::string_view top : {"home", "root", "Users", "work", "mnt"})
        if (has_path_below(file.lines[i], top)) ADD_FAILURE() << place(file, i);
}

TEST(Texts, hold_no_unfinished_mark) {
  for (const TextFile& file : read_texts(everything))
    for (std::size_t i = 0; i < file.lines.size(); ++i)
      for (std::string_view mark : {"TO"
                                    "DO",
                                    "FIX"
                                    "ME",
                                    "XX"
                                    "X",
                                    "HA"
                                    "CK"})
        if (has_word(file.lines[i], mark)) ADD_FAILURE() << place(file, i);
}

TEST(Texts, paths_and_marks_are_recognised) {
  const std::string home = std::string("/ho") + "me/";
  EXPECT_TRUE(has_path_below("see \"" + home + "me/x\"", "home"));
  EXPECT_FALSE(has_path_below("www.example.org" + home, "home"));
  EXPECT_TRUE(
      has_word("// "
               "TO"
               "DO: later",
               "TO"
               "DO"));
  EXPECT_FALSE(has_word("mkstemp(\"aXXXXXX\")",
                        "XX"
                        "X"));
}

}  // namespace
}  // namespace talus::house
