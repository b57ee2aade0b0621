/// Dependencies between the folders of src are acyclic (docs/architecture.md), as read from the #include
/// lines.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "unit/house/source_tree.h"

namespace talus::house {
namespace {

/// Permitted dependencies of each folder, as prefixes of include paths; all of them are used.
/// docs/architecture.md lists the rooms in an order in which each depends only on earlier ones.
const std::map<std::string, std::vector<std::string>> rooms = {
    {"base", {}},
    {"core", {"base/"}},
    {"contact", {"base/", "core/"}},
    {"solver", {"base/", "core/"}},
    {"dynamics", {"base/", "contact/", "core/", "solver/"}},
    {"stress", {"core/"}},
    {"analysis", {"base/", "core/", "stress/"}},
    {"io", {"analysis/", "base/", "core/", "scenario/"}},
    {"scenario", {"base/", "core/"}},
    {"runs", {"analysis/", "base/", "core/", "io/", "scenario/", "stress/"}},
    {"session", {"base/", "contact/", "core/", "dynamics/", "io/", "runs/", "scenario/", "stress/"}},
    {"library",
     {"analysis/", "base/", "core/", "io/", "pictures/", "render/", "runs/", "scenario/", "session/"}},
    {"problems", {"base/", "core/", "dynamics/", "io/", "scenario/", "session/", "solver/"}},
    {"pictures", {"analysis/", "base/", "core/", "io/", "render/", "stress/"}},
    {"ensemble", {"analysis/", "base/", "core/", "io/", "runs/", "scenario/", "session/"}},
    {"exports", {"analysis/", "base/", "core/", "io/", "pictures/", "runs/", "session/", "stress/", "view/"}},
    {"view",
     {"analysis/", "base/", "core/", "io/", "pictures/", "render/colour.h", "render/frame_view.h", "runs/",
      "scenario/", "session/", "stress/"}},
    {"gui", {"base/", "core/", "pictures/", "render/", "view/"}},
    {"render", {"base/"}},
    {"app",
     {"analysis/", "base/", "core/", "ensemble/", "exports/", "gui/", "io/", "pictures/", "problems/",
      "render/", "runs/", "scenario/", "session/", "view/"}},
};

/// Header of another project, with the only place that includes it.
struct Home {
  std::string header;  ///< beginning of the include path
  std::string path;    ///< beginning of the path of the including file
};
const std::vector<Home> homes = {
    {"CLI/", "src/app/"},
    {"EGL/", "render/context_egl.cpp"},
    {"Eigen/", "src/core/tensor"},
    {"GL/glcorearb.h", "render/gl_loader.h"},
    {"GLFW/", "src/gui/window.cpp"},
    {"cairo-", "render/pdf_target.cpp"},
    {"fmt/core.h", ""},  // any folder
    {"hdf5", "src/io/hdf5_file.h"},
    {"imgui", "src/gui/"},
    {"immintrin.h", "src/solver/"},
    {"nlohmann/", "src/app/json.h"},
    {"nlohmann/", "src/ensemble/ensemble_manifest.cpp"},
    {"nlohmann/", "src/exports/page/page_data.h"},
    {"png.h", "render/png"},
    {"stb/", "render/"},
    {"toml++/", "src/scenario/toml.cpp"},
    {"xxhash.h", "src/base/hash.cpp"},
    {"zlib.h", "render/png.cpp"},
    {"zlib.h", "src/exports/page/tables.cpp"},
};

/// Headers of the operating system, which any folder may include.
const std::vector<std::string> of_the_system = {"dlfcn.h", "fcntl.h", "signal.h",
                                                "poll.h",  "sys/",    "unistd.h"};

/// Returns the folder: "core" for "src/core/world.h", "render" for "render/png.h".
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

/// Calls use(file, line index, include) for each include in the folders.
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
      ADD_FAILURE() << file.path << ": this folder has no rule: add one here and to docs/architecture.md";
      return;
    }
    const bool of_the_house = include.quoted || rooms.contains(room_of(include.path));
    const bool of_the_room = room_of(include.path) == room->first;
    if (of_the_house && !of_the_room && !begins_with_one_of(include.path, room->second))
      ADD_FAILURE() << place(file, i) << "\n  " << room->first << " must not include this";
  });
}

TEST(Includes, are_allowed_only_where_they_are_used) {
  std::set<std::pair<std::string, std::string>> unused;
  for (const auto& [room, allowed] : rooms)
    for (const std::string& prefix : allowed) unused.emplace(room, prefix);
  for_each_include([&](const TextFile& file, std::size_t, const Include& include) {
    const std::string room = room_of(file.path);
    std::erase_if(unused, [&](const auto& rule) {
      return rule.first == room && include.path.starts_with(rule.second);
    });
  });
  for (const auto& [room, prefix] : unused) ADD_FAILURE() << room << " includes nothing of " << prefix;
}

TEST(Includes, keep_each_foreign_library_in_its_room) {
  std::set<std::string> unused;
  for (const Home& home : homes) unused.insert(home.header);
  for_each_include([&](const TextFile& file, std::size_t i, const Include& include) {
    const bool standard = include.path.find_first_of("./") == std::string::npos;
    if (include.quoted || standard || begins_with_one_of(include.path, of_the_system)) return;
    const auto is_of = [&](const Home& home) { return include.path.starts_with(home.header); };
    const auto is_at_home = [&](const Home& home) { return is_of(home) && file.path.starts_with(home.path); };
    const auto home = std::ranges::find_if(homes, is_of);
    if (home == homes.end()) {
      ADD_FAILURE() << place(file, i) << "\n  this library has no place: add one here";
      return;
    }
    unused.erase(home->header);
    if (std::ranges::none_of(homes, is_at_home))
      ADD_FAILURE() << place(file, i) << "\n  belongs in " << home->path << " only";
  });
  for (const std::string& header : unused) ADD_FAILURE() << "nothing includes " << header;
}

/// Returns whether the names of a folder belong to namespace talus itself: those of base and core, and the
/// interface of the library.
bool is_in_talus_itself(const std::string& room) {
  return room == "base" || room == "core" || room == "library";
}

TEST(Rooms, have_each_a_namespace) {
  for (const TextFile& file : read_texts({"src", "render"})) {
    const std::string room = room_of(file.path);
    const std::string own = is_in_talus_itself(room) ? "namespace talus {" : "namespace talus::" + room;
    for (std::size_t i = 0; is_source(file) && i < file.lines.size(); ++i) {
      const std::string& line = file.lines[i];
      if (!line.starts_with("namespace talus") || line.starts_with("namespace talus::embedded ")) continue;
      const std::string next = i + 1 < file.lines.size() ? file.lines[i + 1] : "";
      const bool declares_another = next.starts_with("class ") || next.starts_with("struct ");
      const bool is_own = line == own || line == own + " {" || line.starts_with(own + "::");
      if (!is_own && !(declares_another && next.ends_with(";")))
        ADD_FAILURE() << place(file, i) << "\n  expected " << own;
    }
  }
}

TEST(Rooms, below_app_do_not_print) {
  for (const TextFile& file : read_texts({"src", "render"})) {
    if (!is_source(file) || file.path.starts_with("src/app/")) continue;
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      const std::string code = file.lines[i].substr(0, file.lines[i].find("//"));
      for (std::string_view word :
           {"printf", "puts", "putchar", "perror", "cout", "cerr", "clog", "stdout", "stderr"})
        if (has_word(code, word)) ADD_FAILURE() << place(file, i) << "\n  only app may print";
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
