/// The house stays small: a budget of lines for each room of src, and for render. A commit that raises a
/// budget says what another room has lost.

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "unit/house/source_tree.h"

namespace talus::house {
namespace {

const std::map<std::string, std::size_t> budgets = {
    {"src/analysis", 5543}, {"src/app", 7131},      {"src/base", 1972},     {"src/contact", 730},
    {"src/core", 955},      {"src/dynamics", 1370}, {"src/ensemble", 3296}, {"src/exports", 2035},
    {"src/gui", 4390},      {"src/io", 4930},       {"src/library", 924},   {"src/pictures", 4365},
    {"src/problems", 1015}, {"src/runs", 850},      {"src/scenario", 2007}, {"src/session", 4770},
    {"src/solver", 2680},   {"src/stress", 460},    {"src/view", 3780},     {"render", 3768},
};
constexpr std::size_t max_files = 390;

/// Returns the room of a source: "src/io" for src/io/run_file.cpp, "render" for render/png.cpp.
std::string name_of_room(const std::string& path) {
  const std::size_t end = path.starts_with("src/") ? path.find('/', 4) : path.find('/');
  return path.substr(0, end);
}

TEST(Budget, a_room_has_no_more_lines_than_it_may) {
  std::map<std::string, std::size_t> lines;
  std::size_t files = 0;
  for (const TextFile& file : read_texts({"src", "render"})) {
    if (!file.path.ends_with(".cpp") && !file.path.ends_with(".h")) continue;
    lines[name_of_room(file.path)] += file.lines.size();
    ++files;
  }
  for (const auto& [room, count] : lines) {
    const auto budget = budgets.find(room);
    ASSERT_NE(budget, budgets.end()) << room << " has no budget";
    EXPECT_LE(count, budget->second) << room << ": take lines out, or lower the budget of another room";
  }
  for (const auto& [room, budget] : budgets) EXPECT_TRUE(lines.contains(room)) << "no room " << room;
  EXPECT_LE(files, max_files);
}

}  // namespace
}  // namespace talus::house
