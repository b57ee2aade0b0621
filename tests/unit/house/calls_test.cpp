/// Calls that bypass error messages: functions of std::filesystem that throw, and terminal output that is not
/// filtered for control sequences.

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "support/has.h"
#include "unit/house/source_tree.h"

namespace talus::house {
namespace {

/// File without comments as one text, with the line number of each character.
struct Code {
  explicit Code(const TextFile& file) {
    for (std::size_t k = 0; k < file.lines.size(); ++k) {
      const std::string line = file.lines[k].substr(0, file.lines[k].find("//")) + "\n";
      text += line;
      lines.insert(lines.end(), line.size(), k);
    }
  }
  std::string text;
  std::vector<std::size_t> lines;
};

/// Returns the last of the arguments that begin at `begin`, after the bracket.
std::string last_argument(const std::string& text, std::size_t begin) {
  int depth = 0;
  std::size_t last = begin, end = begin;
  for (; end < text.size(); ++end) {
    const char c = text[end];
    if (c == '(' || c == '[' || c == '{') ++depth;
    if ((c == ')' || c == ']' || c == '}') && --depth < 0) break;
    if (c == ',' && depth == 0) last = end + 1;
  }
  std::string argument = text.substr(last, end - last);
  std::erase_if(argument, [](unsigned char c) { return std::isspace(c) != 0; });
  return argument;
}

/// Returns the names of all objects and parameters of type std::error_code in a file.
std::set<std::string> error_codes(const std::string& text) {
  static const std::regex declared(R"(std::error_code\s*&?\s*(\w+))");
  std::set<std::string> names;
  for (std::sregex_iterator at(text.begin(), text.end(), declared), end; at != end; ++at)
    names.insert((*at)[1]);
  return names;
}

/// Returns the places of calls into std::filesystem that throw because they have no error_code. Paths do not
/// throw.
std::vector<std::string> throwing_calls(const TextFile& file) {
  static const std::regex call(
      R"((?:std::filesystem|\bfs)::(?!path\b)(\w+)(?:\s+\w+)?\s*[({]|\b(directory_entry)\b)");
  const Code code(file);
  const auto has = [&code](const char* word) { return test::has(code.text, word); };
  if (!has("fs::") && !has("std::filesystem") && !has("directory_entry")) return {};  // the search is slow
  const std::set<std::string> names = error_codes(code.text);
  std::vector<std::string> found;
  for (std::sregex_iterator at(code.text.begin(), code.text.end(), call), end; at != end; ++at) {
    const auto begin = static_cast<std::size_t>(at->position() + at->length());
    const bool entry =
        (*at)[2].matched;  // the queries of a directory_entry throw too, and so does a loop over a folder
    if (entry || !names.contains(last_argument(code.text, begin)))
      found.push_back(place(file, code.lines[static_cast<std::size_t>(at->position())]));
  }
  return found;
}

TEST(Calls, of_std_filesystem_have_an_object_for_the_error) {
  for (const TextFile& file : read_texts({"src", "render"}))
    if (is_source(file))
      for (const std::string& found : throwing_calls(file))
        ADD_FAILURE() << found << ": throws without a message; base/output_file.h has replacements";
}

TEST(Calls, that_throw_are_found) {
  const auto count = [](const std::vector<std::string>& lines) {
    return throwing_calls({"f.cpp", lines}).size();
  };
  EXPECT_EQ(count({"if (fs::exists(path)) return;"}), 1u);
  EXPECT_EQ(count({"std::error_code none;", "if (fs::exists(f(a, none))) return;"}), 1u);
  EXPECT_EQ(count({"for (const auto& e : std::filesystem::directory_iterator(", "  folder))"}), 1u);
  EXPECT_EQ(count({"std::error_code none;", "fs::directory_iterator at(folder, none), end;"}), 0u);
  EXPECT_EQ(
      count({"std::error_code none;", "const bool is = std::filesystem::exists(fs::path(a) / b, none);"}),
      0u);
  EXPECT_EQ(count({"const fs::path path = fs::path(a);  // not fs::exists(a)"}), 0u);
}

TEST(Calls, that_print_are_in_one_file) {
  const std::vector<std::string> words = {"printf", "fprintf", "vprintf", "vfprintf", "puts",
                                          "fputs",  "putchar", "putc",    "fputc",    "perror",
                                          "cout",   "cerr",    "clog",    "psignal"};
  for (const TextFile& file : read_texts({"src", "render"})) {
    if (!is_source(file) || file.path == "src/app/terminal.cpp") continue;
    for (std::size_t k = 0; k < file.lines.size(); ++k) {
      const std::string code = file.lines[k].substr(0, file.lines[k].find("//"));
      const bool prints =
          test::has(code, "fmt::print") || std::ranges::any_of(words, [&](const std::string& word) {
            return has_word(code, word) && !test::has(code, "gnu::format");
          });
      if (prints) ADD_FAILURE() << place(file, k) << ": print through app/terminal.h";
    }
  }
}

}  // namespace
}  // namespace talus::house
