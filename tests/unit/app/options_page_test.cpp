/// docs/options.md lists the commands that share an option, as the parser has them, and shared options have
/// the same meaning everywhere.

#include <gtest/gtest.h>

#include <algorithm>
#include <fmt/core.h>
#include <fstream>
#include <map>
#include <set>

#include "app/command_tree.h"
#include "app/commands.h"
#include "app/value_words.h"
#include "base/text.h"
#include "support/places.h"

namespace talus::app {
namespace {

struct SharedOption {
  std::vector<std::string> commands;
  std::set<std::string> values;
};

void collect(const CommandPage& page, std::map<std::string, SharedOption>& options) {
  for (const OptionPage& option : page.options) {
    if (option.names.empty() || option.names.back() == "--help") continue;
    SharedOption& shared = options[option.names.back()];
    shared.commands.push_back(page.name.substr(page.name.find(' ') + 1));
    shared.values.insert(option.choices.empty() ? option.value : joined(option.choices, "|"));
  }
  for (const CommandPage& command : page.commands) collect(command, options);
}

/// Returns the options that at least two commands have.
std::map<std::string, SharedOption> shared_options() {
  CLI::App app;
  add_commands(app);
  name_values(app);
  std::map<std::string, SharedOption> options;
  for (const CommandPage& command : command_tree(app, "talus").commands) collect(command, options);
  std::erase_if(options, [](const auto& option) { return option.second.commands.size() < 2; });
  return options;
}

std::string table_of(const std::map<std::string, SharedOption>& options) {
  std::string table = "| option | commands |\n|---|---|\n";
  for (const auto& [name, shared] : options) {
    std::string head = name;
    for (const std::string& value : shared.values)
      if (!value.empty()) head += (head == name ? " " : " or ") + value;
    for (std::size_t bar = head.find('|'); bar != std::string::npos; bar = head.find('|', bar + 2))
      head.insert(bar, 1, '\\');  // an unescaped bar would end the cell
    table += fmt::format("| `{}` | {} |\n", head, joined(shared.commands, ", "));
  }
  return table;
}

TEST(OptionsPage, has_the_table_of_the_parser) {
  if (!has_window) GTEST_SKIP() << "built without talus view";
  std::ifstream file(test::source_folder() + "/docs/options.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}}, table = table_of(shared_options());
  EXPECT_NE(page.find(table), std::string::npos) << "docs/options.md must have this table:\n" << table;
}

/// A frame, a threshold or a key has the same syntax everywhere.
TEST(OptionsPage, shared_options_have_one_kind_of_value) {
  const std::map<std::string, SharedOption> options = shared_options();
  const std::map<std::string, std::set<std::string>> kinds = {
      {"--at", {"DEG,...", "DEG"}},  // several frames, or one
      {"--theta-c", {"DEG"}},       {"--threshold", {"FACTOR"}}, {"--l-min", {"D"}},
      {"--frames", {"K,K-K,..."}},  {"--set", {"KEY=VALUE"}},    {"--every", {"DEG"}}};
  for (const auto& [name, values] : kinds) {
    ASSERT_TRUE(options.contains(name)) << name;
    EXPECT_EQ(options.at(name).values, values) << name;
  }
}

}  // namespace
}  // namespace talus::app
