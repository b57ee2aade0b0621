/// Equations cited in the code exist in docs/theory.md, and all of its equations and sources are cited.

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>
#include <vector>

#include "unit/house/source_tree.h"

namespace talus::house {
namespace {

const std::string theory = "docs/theory.md";

/// Returns the first group of each match of a pattern in a line.
std::vector<std::string> matches(const std::string& line, const std::string& pattern) {
  const std::regex expression(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator at(line.begin(), line.end(), expression), end; at != end; ++at)
    found.push_back((*at)[1]);
  return found;
}

/// Returns the number of an equation, which ends an indented line.
std::vector<std::string> defined_in(const std::string& line) {
  if (line.find("(T") == std::string::npos) return {};  // regular expressions are slow
  return matches(line, R"(^    .*\((T\d+)\)$)");
}
std::vector<std::string> cited_in(const std::string& line) {
  if (line.find("(T") == std::string::npos) return {};
  return matches(line, R"(\((T\d+)\))");
}

std::vector<std::string> defined_equations() {
  std::vector<std::string> defined;
  for (const TextFile& page : read_texts({"docs"}))
    if (page.path == theory)
      for (const std::string& line : page.lines)
        for (const std::string& equation : defined_in(line)) defined.push_back(equation);
  return defined;
}

TEST(Theory, equations_are_numbered_in_their_order) {
  const std::vector<std::string> defined = defined_equations();
  ASSERT_GT(defined.size(), 20u) << theory;
  for (std::size_t k = 0; k < defined.size(); ++k) EXPECT_EQ(defined[k], "T" + std::to_string(k + 1));
}

TEST(Theory, equations_are_cited_where_they_are_defined_and_the_other_way_round) {
  const std::vector<std::string> defined = defined_equations();
  const std::set<std::string> known(defined.begin(), defined.end());
  std::set<std::string> uncited = known;
  for (const TextFile& file : read_texts({"src", "python"})) {
    if (!is_source(file) && !file.path.ends_with(".py")) continue;
    for (std::size_t i = 0; i < file.lines.size(); ++i)
      for (const std::string& equation : cited_in(file.lines[i])) {
        uncited.erase(equation);
        if (!known.contains(equation))
          ADD_FAILURE() << place(file, i) << "\n  " << theory << " has no equation " << equation;
      }
  }
  for (const std::string& equation : uncited) ADD_FAILURE() << theory << ": no source cites " << equation;
}

TEST(Theory, sources_stand_among_the_references) {
  std::set<std::string> references;
  std::size_t count = 0;
  for (const TextFile& file : read_texts({"docs"}))
    if (file.path == "docs/references.bib")
      for (const std::string& line : file.lines)
        for (const std::string& key : matches(line, R"(^@\w+\{(\w+),)")) references.insert(key);
  for (const TextFile& page : read_texts({"docs"})) {
    if (page.path != theory) continue;
    for (std::size_t i = 0; i < page.lines.size(); ++i)
      for (const std::string& key : matches(page.lines[i], R"(`([a-z]+\d{4})`)")) {
        ++count;
        if (!references.contains(key)) ADD_FAILURE() << place(page, i) << "\n  no reference " << key;
      }
  }
  EXPECT_GT(count, 10u);
}

TEST(Theory, numbers_are_recognised) {
  EXPECT_EQ(defined_in("    a = b    (T7)"), std::vector<std::string>{"T7"});
  EXPECT_TRUE(defined_in("As (T7)").empty());
  EXPECT_EQ(cited_in("/// Computes (T4) and (T12)."), (std::vector<std::string>{"T4", "T12"}));
  EXPECT_TRUE(cited_in("f(T t)").empty());
}

}  // namespace
}  // namespace talus::house
