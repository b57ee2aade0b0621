/// The rooms of the house are used one way only (docs/architecture.md): read from the #include lines.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "unit/house/source_tree.h"

namespace talus::house {
namespace {

/// What each room may include of the project: prefixes of include paths.
const std::map<std::string, std::vector<std::string>> rooms = {
    {"core", {"core/"}},
    {"contact", {"contact/", "core/"}},
    {"solver", {"solver/", "core/"}},
    {"dynamics", {"dynamics/", "contact/", "solver/", "core/"}},
    {"stress", {"stress/", "core/"}},
    {"analysis", {"analysis/", "stress/", "core/"}},
    {"io", {"io/", "core/", "stress/"}},
    {"session",
     {"session/", "dynamics/", "contact/", "solver/", "stress/", "analysis/", "io/", "core/",
      "render/frame_view.h"}},
    {"figures",
     {"figures/", "session/", "analysis/", "stress/", "io/", "maps/", "core/", "render/frame_view.h"}},
    {"reproduction", {"reproduction/", "figures/", "session/", "analysis/", "io/", "core/"}},
    {"maps",
     {"maps/", "analysis/", "core/", "stress/", "render/frame_view.h", "render/colour.h",
      "render/colour_map.h"}},
    {"view",
     {"view/", "session/", "maps/", "analysis/", "stress/", "io/", "core/", "render/frame_view.h",
      "render/colour.h", "render/colour_map.h"}},
    {"gui", {"gui/", "view/", "maps/", "core/", "render/"}},
    {"render", {"render/", "core/descriptor.h", "core/errors.h", "core/locked_file.h"}},
    {"app", {""}},
};

/// Headers of other projects that have one home each.
struct Home {
  std::string header;  ///< how an include path begins
  std::string path;    ///< how the path of the file that includes it begins
};
const std::vector<Home> homes = {
    {"hdf5", "src/io/"},
    {"imgui", "src/gui/"},
    {"GLFW/", "src/gui/window.cpp"},
    {"toml++/", "src/session/scenario_toml.cpp"},
    {"CLI/", "src/app/"},
};

/// "src/core/world.h" is in room "core", "render/png.h" in room "render".
std::string room_of(const std::string& path) {
  const std::string inside = path.starts_with("src/") ? path.substr(4) : path;
  return inside.substr(0, inside.find('/'));
}

struct Include {
  std::string path;
  bool quoted;
};

std::optional<Include> parse_include(std::string_view line) {
  const auto hash = line.find_first_not_of(" \t");
  if (hash == std::string_view::npos || line[hash] != '#' || !has_word(line, "include")) return std::nullopt;
  const auto open = line.find_first_of("<\"");
  if (open == std::string_view::npos) return std::nullopt;
  const auto close = line.find_first_of(">\"", open + 1);
  return Include{std::string(line.substr(open + 1, close - open - 1)), line[open] == '"'};
}

bool begins_with_one_of(const std::string& path, const std::vector<std::string>& prefixes) {
  return std::ranges::any_of(prefixes, [&](const std::string& prefix) { return path.starts_with(prefix); });
}

/// Calls use(file, line index, include) for each include of the rooms.
template <typename Use>
void for_each_include(const Use& use) {
  std::size_t count = 0;
  for (const TextFile& file : read_texts({"src", "render"})) {
    if (!is_source(file)) continue;
    for (std::size_t i = 0; i < file.lines.size(); ++i)
      if (const auto include = parse_include(file.lines[i])) {
        use(file, i, *include);
        ++count;
      }
  }
  EXPECT_GT(count, 20u) << "the sources were not found";
}

TEST(Includes, go_one_way_through_the_rooms) {
  for_each_include([](const TextFile& file, std::size_t i, const Include& include) {
    const auto room = rooms.find(room_of(file.path));
    if (room == rooms.end()) {
      ADD_FAILURE() << file.path << ": its room has no rule: add one here and to docs/architecture.md";
      return;
    }
    const bool of_the_house = include.quoted || rooms.contains(room_of(include.path));
    if (of_the_house && !begins_with_one_of(include.path, room->second))
      ADD_FAILURE() << place(file, i) << "\n  " << room->first << " may not include this";
  });
}

TEST(Includes, keep_each_foreign_library_in_its_room) {
  for_each_include([](const TextFile& file, std::size_t i, const Include& include) {
    for (const Home& home : homes)
      if (include.path.starts_with(home.header) && !file.path.starts_with(home.path))
        ADD_FAILURE() << place(file, i) << "\n  belongs in " << home.path << " only";
  });
}

TEST(Rooms, below_app_do_not_print) {
  for (const TextFile& file : read_texts({"src", "render"})) {
    if (!is_source(file) || file.path.starts_with("src/app/")) continue;
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      const std::string code = file.lines[i].substr(0, file.lines[i].find("//"));
      for (std::string_view word :
           {"printf", "puts", "putchar", "perror", "cout", "cerr", "clog", "stdout", "stderr"})
        if (has_word(code, word)) ADD_FAILURE() << place(file, i) << "\n  only app prints";
    }
  }
}

TEST(Includes, are_parsed_as_written) {
  EXPECT_EQ(parse_include("#include \"core/types.h\"").value().path, "core/types.h");
  EXPECT_EQ(parse_include("  # include <hdf5.h>  // why").value().path, "hdf5.h");
  EXPECT_FALSE(parse_include("#pragma once").has_value());
  EXPECT_FALSE(parse_include("// #include <x>").has_value());
}

}  // namespace
}  // namespace talus::house
