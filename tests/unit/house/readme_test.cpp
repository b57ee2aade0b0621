/// The commands of the README are those that exist, and its test command is the one that every change must
/// pass.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace talus::house {
namespace {

std::string text_of(const std::string& path) {
  std::ifstream file(std::string(TALUS_SOURCE_DIR) + "/" + path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The lines of a page that are set as commands.
std::vector<std::string> commands(const std::string& page = "README.md") {
  std::istringstream text(text_of(page));
  std::vector<std::string> found;
  for (std::string line; std::getline(text, line);)
    if (line.rfind("    ", 0) == 0) found.push_back(line.substr(4));
  return found;
}

TEST(Readme, test_command_is_the_one_of_ci) {
  bool named = false;
  for (const std::string& command : commands()) named = named || command.rfind("./bootstrap test", 0) == 0;
  EXPECT_TRUE(named);
  EXPECT_NE(text_of(".ci/run").find("\n./bootstrap test\n"), std::string::npos);
}

TEST(Readme, commands_name_what_exists) {
  ASSERT_GT(commands().size(), 5u);
  for (const std::string& command : commands()) {
    std::istringstream words(command);
    std::string program, subcommand, argument;
    words >> program >> subcommand >> argument;
    if (program == "./bootstrap") {
      EXPECT_NE(text_of("bootstrap").find("\n  " + subcommand + " "), std::string::npos) << command;
    } else {
      EXPECT_EQ(program, "build/release/talus");
      EXPECT_TRUE(
          std::filesystem::exists(std::string(TALUS_SOURCE_DIR) + "/src/app/" + subcommand + "_command.cpp"))
          << command;
      if (argument.rfind("assets/", 0) == 0) {
        EXPECT_TRUE(std::filesystem::exists(std::string(TALUS_SOURCE_DIR) + "/" + argument)) << command;
      }
    }
  }
}

TEST(MapsPage, commands_and_options_exist) {
  ASSERT_GT(commands("docs/maps.md").size(), 3u);
  std::string sources;
  for (const char* name :
       {"map_options", "render_command", "animate_command", "panel_command", "run_command"})
    sources += text_of(std::string("src/app/") + name + ".cpp");
  for (const std::string& command : commands("docs/maps.md")) {
    std::istringstream words(command);
    std::string program, subcommand;
    words >> program >> subcommand;
    EXPECT_EQ(program, "build/release/talus");
    EXPECT_NE(sources.find("\"" + subcommand + "\", \""), std::string::npos) << command;
  }
  const std::string page = text_of("docs/maps.md");
  int options = 0;
  for (std::size_t at = page.find("--"); at != std::string::npos; at = page.find("--", at + 1)) {
    const std::size_t end = page.find_first_not_of("-abcdefghijklmnopqrstuvwxyz", at);
    const std::string option = page.substr(at, end - at);
    if (option.find_first_not_of('-') == std::string::npos) continue;  // the line of a table
    EXPECT_NE(sources.find(option), std::string::npos) << option;
    ++options;
    at = end;
  }
  EXPECT_GT(options, 20);
}

TEST(Readme, pages_it_links_to_exist) {
  const std::string readme = text_of("README.md");
  int links = 0;
  for (std::size_t at = readme.find("]("); at != std::string::npos; at = readme.find("](", at + 1)) {
    const std::string target = readme.substr(at + 2, readme.find(')', at) - at - 2);
    EXPECT_TRUE(std::filesystem::exists(std::string(TALUS_SOURCE_DIR) + "/" + target)) << target;
    ++links;
  }
  EXPECT_GT(links, 5);
}

}  // namespace
}  // namespace talus::house
