/// Commands and options in the pages exist, and the test command of the README is the one that every change
/// must pass.

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "support/has.h"
#include "support/places.h"
#include "support/process.h"

namespace talus::house {
namespace {

std::string text_of(const std::string& path) { return test::text_of(test::source_folder() + "/" + path); }

/// Returns the command lines of a page, which are indented; fenced code has none.
std::vector<std::string> commands(const std::string& page = "README.md") {
  std::istringstream text(text_of(page));
  std::vector<std::string> found;
  bool fenced = false;
  for (std::string line; std::getline(text, line);) {
    fenced = fenced != (test::has(line, "```"));
    if (!fenced && line.rfind("    ", 0) == 0) found.push_back(line.substr(4));
  }
  return found;
}

TEST(Readme, test_command_is_the_one_of_ci) {
  bool named = false;
  for (const std::string& command : commands()) named = named || command.rfind("./bootstrap test", 0) == 0;
  EXPECT_TRUE(named);
  EXPECT_TRUE(test::has(text_of(".ci/run"), "\n./bootstrap test\n"));
}

/// Returns the lines between two lines of a text.
std::vector<std::string> lines_between(const std::string& text, const std::string& first,
                                       const std::string& last) {
  std::istringstream stream(text);
  std::vector<std::string> found;
  bool inside = false;
  for (std::string line; std::getline(stream, line) && !(inside && line == last);) {
    if (inside) found.push_back(line);
    inside = inside || line == first;
  }
  return found;
}

/// Formats "a | b | c" as a table row of a page: "| `a` | b | c |".
std::string row_of_page(const std::string& row) {
  const std::size_t end = row.find_first_of(" |");
  return "| `" + row.substr(0, end) + "` " + row.substr(row.find('|')) + " |";
}

TEST(Testing, page_has_the_parts_of_the_full_check) {
  const std::vector<std::string> parts =
      lines_between(text_of(".ci/full"), "  sed 's/ *| */\\t/g' <<'TABLE'", "TABLE");
  ASSERT_GT(parts.size(), 10u);
  const std::string page = text_of("docs/testing.md");
  std::string table;
  for (const std::string& part : parts) table += row_of_page(part) + "\n";
  EXPECT_TRUE(test::has(page, "|---|---|---|\n" + table)) << table;
}

TEST(Readme, commands_name_what_exists) {
  ASSERT_GT(commands().size(), 5u);
  for (const std::string& command : commands()) {
    std::istringstream words(command);
    std::string program, subcommand, argument;
    words >> program >> subcommand >> argument;
    if (program == "./bootstrap") {
      EXPECT_TRUE(test::has(text_of("bootstrap"), "\n  " + subcommand + " ")) << command;
    } else {
      EXPECT_EQ(program, "build/release/talus");
      EXPECT_TRUE(test::has(text_of("src/app/commands.cpp"), "add_" + subcommand + "_command")) << command;
      if (argument.rfind("assets/", 0) == 0) {
        EXPECT_TRUE(std::filesystem::exists(test::source_folder() + "/" + argument)) << command;
      }
    }
  }
}

/// Returns a page without the commands that open it in a browser, whose options are not those of Talus.
std::string without_browser(const std::string& page) {
  std::istringstream text(page);
  std::string rest;
  for (std::string line; std::getline(text, line);)
    if (!line.starts_with("    chromium ")) rest += line + "\n";
  return rest;
}

/// Checks that the commands of a page are subcommands defined by these sources, and that its options are
/// theirs; returns the number of options.
int check_page(const std::string& name, const std::vector<const char*>& sources_of) {
  std::string sources = text_of("src/app/options.cpp");
  for (const char* source : sources_of) sources += text_of(std::string("src/app/") + source + ".cpp");
  for (const std::string& command : commands(name)) {
    std::istringstream words(command);
    std::string program, subcommand;
    words >> program >> subcommand;
    if (program == "chromium" || program.starts_with("docs/")) continue;
    EXPECT_EQ(program, "build/release/talus");
    EXPECT_TRUE(test::has(sources, "\"" + subcommand + "\",")) << command;
  }
  const std::string page = without_browser(text_of(name));
  int options = 0;
  for (std::size_t at = page.find("--"); at != std::string::npos; at = page.find("--", at + 1)) {
    const std::size_t end = page.find_first_not_of("-abcdefghijklmnopqrstuvwxyz", at);
    const std::string option = page.substr(at, end - at);
    const bool comment = at > 1 && page.compare(at - 2, 2, "<!") == 0;
    if (comment || option.find_first_not_of('-') == std::string::npos) continue;  // or the rule of a table
    EXPECT_TRUE(test::has(sources, option)) << option;
    ++options;
    at = end;
  }
  return options;
}

TEST(MapsPage, commands_and_options_exist) {
  ASSERT_GT(commands("docs/maps.md").size(), 3u);
  EXPECT_GT(check_page("docs/maps.md", {"map_options", "frame_options", "render_command", "animate_command",
                                        "panel_command", "run_command", "maps_command"}),
            20);
}

TEST(ViewPage, commands_and_options_exist) {
  ASSERT_GT(commands("docs/view.md").size(), 3u);
  EXPECT_GT(check_page("docs/view.md", {"view_command", "replay_command", "info_command", "render_command",
                                        "map_options", "analyze_command"}),
            2);
}

TEST(AnalysisPage, commands_and_options_exist) {
  ASSERT_GT(commands("docs/analysis.md").size(), 1u);
  EXPECT_GT(check_page("docs/analysis.md", {"analyze_command", "forces_command", "events_command",
                                            "info_command", "run_command", "frame_options"}),
            10);
}

TEST(ExportPage, commands_and_options_exist) {
  ASSERT_GT(commands("docs/export.md").size(), 0u);
  EXPECT_GT(check_page("docs/export.md", {"export_command", "frame_options"}), 7);
}

TEST(ViewPage, lists_the_keys_of_the_window) {
  const std::string page = text_of("docs/view.md"), keys = text_of("src/gui/keys.cpp");
  const std::string table = page.substr(page.find("| key |"));
  const std::string begin = "\n    {\"";
  int found = 0;
  for (std::size_t at = keys.find(begin); at != std::string::npos; at = keys.find(begin, at + 1)) {
    const std::size_t from = at + begin.size();
    std::istringstream line(keys.substr(from, keys.find("\",", from) - from));
    for (std::string key; line >> key; ++found) {
      if (key.size() > 1 && key.back() == ',') key.pop_back();
      EXPECT_TRUE(test::has(table, key)) << key;
    }
  }
  EXPECT_GT(found, 40);
}

TEST(Readme, pages_it_links_to_exist) {
  const std::string readme = text_of("README.md");
  int links = 0;
  for (std::size_t at = readme.find("]("); at != std::string::npos; at = readme.find("](", at + 1)) {
    const std::string target = readme.substr(at + 2, readme.find(')', at) - at - 2);
    EXPECT_TRUE(std::filesystem::exists(test::source_folder() + "/" + target)) << target;
    ++links;
  }
  EXPECT_GT(links, 5);
}

}  // namespace
}  // namespace talus::house
