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

/// The lines of the README that are set as commands.
std::vector<std::string> commands() {
  std::istringstream text(text_of("README.md"));
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
