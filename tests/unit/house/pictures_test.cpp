/// Every picture of README and docs is made by docs/images/make, by commands that are printed on its page.
/// Those of the cookbook are drawn by its recipes, as tests/python shows.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "support/places.h"
#include "unit/house/source_tree.h"

namespace talus::house {
namespace {

namespace fs = std::filesystem;

using Commands = std::vector<std::string>;

std::string trimmed(const std::string& line) {
  const std::size_t begin = line.find_first_not_of(' ');
  return begin == std::string::npos ? "" : line.substr(begin);
}

/// The script, and the text between a line that ends with <<'SH' and the line SH.
const TextFile& script(const std::vector<TextFile>& docs) {
  return *std::ranges::find(docs, "docs/images/make", &TextFile::path);
}

struct Picture {
  Commands needed;    ///< that make what it is drawn from
  Commands commands;  ///< that draw it
};

std::map<std::string, Picture> pictures_of(const TextFile& script) {
  std::map<std::string, Picture> pictures;
  Commands needed;
  Commands* taking = nullptr;
  for (const std::string& line : script.lines) {
    if (taking != nullptr) {
      if (line == "SH")
        taking = nullptr;
      else
        taking->push_back(trimmed(line));
    } else if (line.starts_with("needs ") || line.starts_with("also_needs ")) {
      if (line.starts_with("needs ")) needed.clear();
      if (line.ends_with("<<'SH'")) taking = &needed;
    } else if (line.starts_with("picture ")) {
      Picture& picture = pictures[line.substr(8, line.find(' ', 8) - 8)];
      picture.needed = needed;
      taking = &picture.commands;
    }
  }
  return pictures;
}

/// The names of the pictures that a page shows.
std::vector<std::string> shown_on(const TextFile& page) {
  const std::string folder = "images/";
  std::vector<std::string> names;
  for (const std::string& line : page.lines) {
    if (line.find("![") == std::string::npos) continue;
    const std::size_t begin = line.find(folder, line.find("](")) + folder.size();
    names.push_back(line.substr(begin, line.find(".png", begin) - begin));
  }
  return names;
}

bool prints(const TextFile& page, const std::string& command) {
  return std::ranges::any_of(page.lines, [&](const std::string& line) {
    return line.starts_with("    ") && trimmed(line) == command;
  });
}

TEST(Pictures, are_made_by_the_commands_beside_them) {
  const std::vector<TextFile> docs = read_texts({"docs", "."});
  const std::map<std::string, Picture> pictures = pictures_of(script(docs));
  ASSERT_GT(pictures.size(), 4u);
  std::set<std::string> shown;
  for (const TextFile& page : docs) {
    if (!page.path.ends_with(".md") || page.path == "docs/cookbook.md") continue;
    for (const std::string& name : shown_on(page)) {
      shown.insert(name);
      ASSERT_TRUE(pictures.contains(name)) << page.path << " shows " << name << ", which the script lacks";
      for (const std::string& command : pictures.at(name).commands)
        EXPECT_TRUE(prints(page, command)) << page.path << " shows " << name << " without: " << command;
      // A run that many pages draw from is made on one of them.
      for (const std::string& command : pictures.at(name).needed)
        EXPECT_TRUE(std::ranges::any_of(
            docs, [&](const TextFile& any) { return any.path.ends_with(".md") && prints(any, command); }))
            << page.path << " shows " << name << ", and no page prints: " << command;
    }
  }
  for (const auto& [name, picture] : pictures) {
    EXPECT_FALSE(picture.commands.empty()) << name;
    EXPECT_TRUE(shown.contains(name)) << "no page shows " << name;
  }
  const fs::path folder = fs::path(test::source_folder()) / "docs/images";
  for (const auto& file : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(file.path(), folder).replace_extension().string();
    if (file.path().extension() == ".png" && !name.starts_with("cookbook/")) {
      EXPECT_TRUE(shown.contains(name)) << "no page shows " << file.path();
    }
  }
}

TEST(Pictures, of_first_pages_are_small) {
  for (const char* name : {"tutorial", "gallery"}) {
    int found = 0;
    for (const auto& file : fs::directory_iterator(fs::path(test::source_folder()) / "docs/images" / name)) {
      EXPECT_LT(file.file_size(), 150'000u) << file.path();
      ++found;
    }
    EXPECT_GT(found, 3) << name;
  }
}

TEST(Pictures, run_of_the_paper_is_made_as_the_readme_says) {
  const std::vector<TextFile> docs = read_texts({"docs", "."});
  const Commands needed = pictures_of(script(docs)).at("failure").needed;
  ASSERT_FALSE(needed.empty());
  EXPECT_TRUE(prints(*std::ranges::find(docs, "README.md", &TextFile::path), needed.front()));
}

}  // namespace
}  // namespace talus::house
